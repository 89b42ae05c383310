// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of a few quads whose links are given one by one.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "links/build_link_set.h"
#include "prune/node_shapes.h"
#include "prune/prune.h"
#include "scene/ray_scene.h"
#include "support/scene_builder.h"
#include "support/tree_builder.h"

namespace antiradiance::test {

// Quads of the plane z = height, x and y from low to high.
struct HandMadeLinks {
    explicit HandMadeLinks(int bin_count = 128) : bins(bin_count) {
        add_material(scene, vec3(0.5F));
    }

    // Facing down, as a sender at the top does, or up.
    void add(const std::string& name, float height, const vec2& low, const vec2& high, bool down) {
        const vec3 x(high.x - low.x, 0, 0);
        const vec3 y(0, high.y - low.y, 0);
        add_quad(scene, name, vec3(low, height), down ? y : x, down ? x : y, 0);
    }
    // Ends the scene; no edge of a patch is longer than max_edge (m).
    void make_tree(float max_edge = 100) { tree = front_tree(scene, max_edge); }

    // The node that is all of a quad.
    [[nodiscard]] NodeId node(const std::string& name) const {
        for (std::size_t s = 0; s < tree.surfaces.size(); ++s) {
            if (scene.objects[static_cast<std::size_t>(tree.surfaces[s].object)].name == name)
                return tree.surface_node[s];
        }
        ADD_FAILURE() << name;
        return kNone;
    }
    // The cluster of these two quads and no others.
    [[nodiscard]] NodeId cluster(const std::string& one, const std::string& other) const {
        const NodeId a = node(one);
        const NodeId b = node(other);
        const NodeId up = tree.parent[static_cast<std::size_t>(a)];
        EXPECT_EQ(up, tree.parent[static_cast<std::size_t>(b)]) << one << ", " << other;
        EXPECT_EQ(NodeShapes(tree).members(up).size(), 2U) << one << ", " << other;
        return up;
    }
    // The leaf of a quad that holds a point.
    [[nodiscard]] NodeId leaf(const std::string& name, const vec3& point) const {
        const Surface& s = tree.surfaces[static_cast<std::size_t>(
            tree.surface[static_cast<std::size_t>(node(name))])];
        for (const TriangleId t : s.triangles) {
            const NodeId found = tree.lookup(t, false, point);
            if (found != kNone) return found;
        }
        return kNone;
    }

    [[nodiscard]] int bin(NodeId source, NodeId receiver) const {
        return bins.bin(tree.center[static_cast<std::size_t>(receiver)] -
                        tree.center[static_cast<std::size_t>(source)]);
    }
    void plus(NodeId source, NodeId receiver) {
        raw.push_back({receiver, source, 0.01F, static_cast<std::uint16_t>(bin(source, receiver))});
    }
    void minus(NodeId source, NodeId receiver) {
        raw.push_back(
            {receiver, source, -0.01F, static_cast<std::uint16_t>(bin(source, receiver))});
    }
    [[nodiscard]] LinkSet links() const {
        Progress progress;
        return build_link_set(tree, bins, raw, progress);
    }

    [[nodiscard]] LinkSet pruned(const PruneOptions& options) const {
        Progress progress;
        const LinkSet all = links();
        const RayScene rays(scene);
        return prune_links({scene, tree, all, rays}, options, progress).links;
    }
    [[nodiscard]] LinkSet pruned(PruneMethod method) const {
        return pruned(PruneOptions{.method = method});
    }

    Scene scene;
    PatchTree tree;
    DirectionBins bins;
    std::vector<RawLink> raw;
};

// Whether a set holds a link of the given sign.
inline bool holds(const LinkSet& links, NodeId source, NodeId receiver, bool minus) {
    for (const Segment& s : links.segments) {
        if (s.receiver != receiver) continue;
        for (std::uint32_t l = s.begin; l < s.end; ++l) {
            if (links.links[l].source == source && (links.links[l].form_factor < 0) == minus)
                return true;
        }
    }
    return false;
}
inline bool holds_plus(const LinkSet& links, NodeId source, NodeId receiver) {
    return holds(links, source, receiver, false);
}
inline bool holds_minus(const LinkSet& links, NodeId source, NodeId receiver) {
    return holds(links, source, receiver, true);
}

}  // namespace antiradiance::test
