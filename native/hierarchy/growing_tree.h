// SPDX-License-Identifier: GPL-3.0-or-later
// The hierarchy while it grows: nodes in order of creation, with the geometry that link refinement
// asks for again and again. `finish()` turns it into a PatchTree (preorder).
#pragma once

#include <span>
#include <vector>

#include "hierarchy/patch_tree.h"

namespace antiradiance {

struct GrowingNode {
    vec3 center{0};
    float radius = 0;               // m, bounding sphere about the centre
    vec3 normal{0};                 // unit; clusters: mean normal
    float area = 0;                 // m2
    std::array<vec3, 4> corners;    // patches: corner_count of them
    std::int32_t corner_count = 0;  // 0: a cluster
    SurfaceId surface = kNone;
    NodeId parent = kNone;
    NodeId first_child = kNone;  // children are consecutive
    std::int32_t child_count = 0;
    float longest_edge = 0;   // m, patches
    float cone_cosine = 1;    // clusters: all normals lie within this angle's cosine of `normal`
    bool emits_only = false;  // an area lamp
    PatchRegion region;       // patches

    [[nodiscard]] bool is_cluster() const { return corner_count == 0; }
    [[nodiscard]] bool is_leaf() const { return child_count == 0; }
};

class GrowingTree {
public:
    // One root cluster above all surfaces (at least one). Clusters halve on position and normal.
    explicit GrowingTree(std::vector<Surface> surfaces);

    [[nodiscard]] const GrowingNode& node(NodeId n) const {
        return nodes_[static_cast<std::size_t>(n)];
    }
    [[nodiscard]] std::size_t size() const { return nodes_.size(); }
    [[nodiscard]] const std::vector<Surface>& surfaces() const { return surfaces_; }
    static constexpr NodeId kRoot = 0;

    // Gives a leaf patch its children: 4 of equal shape, or 2 across its long direction when it is
    // more than kElongated times as long as wide.
    void split(NodeId leaf);
    // Splits every patch whose longest edge exceeds `max_edge` (m).
    void split_to(float max_edge);

    // Estimate for split_to without making anything: number of patch nodes it would create, and
    // the object that most of them belong to.
    struct Estimate {
        double patches = 0;
        std::int32_t largest_object = kNone;  // into Scene::objects
        double largest_object_patches = 0;
    };
    [[nodiscard]] static Estimate estimate_patches(std::span<const Surface> surfaces,
                                                   float max_edge);

    // The tree in preorder; creation number -> NodeId of the result is written to `renumbered`.
    // scene: the one that the surfaces are of.
    [[nodiscard]] PatchTree finish(const Scene& scene, std::vector<NodeId>& renumbered) const;

    static constexpr float kElongated = 1.6F;

private:
    void build_cluster(NodeId cluster, std::vector<SurfaceId>& members, std::size_t begin,
                       std::size_t end);
    void make_surface_node(NodeId n, SurfaceId surface);
    void set_patch_geometry(GrowingNode& n) const;

    std::vector<Surface> surfaces_;
    std::vector<GrowingNode> nodes_;
};

}  // namespace antiradiance
