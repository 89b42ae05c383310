// SPDX-License-Identifier: GPL-3.0-or-later
// The patch hierarchy: clusters of surfaces above, polygon sides ("surfaces") in the middle, their
// 4-split patches below, in one tree whose nodes are stored in preorder.
#pragma once

#include <array>
#include <vector>

#include "base/types.h"
#include "scene/scene.h"

namespace antiradiance {

// One lit side of an input polygon (a triangle, or two triangles that form a convex planar quad),
// or an area lamp that emits along links.
struct Surface {
    std::array<vec3, 4> corners;  // m, counter-clockwise seen from the lit side; [3] unused if 3
    std::array<TriangleId, 2> triangles{kNone, kNone};
    std::int32_t corner_count = 3;  // 3 or 4
    std::int32_t material = kNone;  // into Scene::materials
    std::int32_t object = kNone;    // into Scene::objects
    std::int32_t lamp = kNone;      // into Scene::lamps: emits only, neither receives nor blocks
    bool back_side = false;         // the lit side is the triangles' back
    bool emits = false;             // an emissive material, or a lamp
};

// A patch's region in its surface: quads a rectangle in (u, v) of the bilinear map, triangles a
// triangle given by its corners' (u, v) = barycentric weights of corners 1 and 2.
struct PatchRegion {
    std::array<vec2, 4> corners;
};

struct PatchTree {
    std::vector<Surface> surfaces;

    // Nodes, in preorder: a subtree is the range [node, subtree_end[node]).    // #nodes each
    std::vector<NodeId> parent;  // kNone: root
    std::vector<NodeId> subtree_end;
    std::vector<std::int32_t> depth;  // root = 0
    std::vector<SurfaceId> surface;   // kNone: a cluster
    std::vector<PatchRegion> region;  // of patches
    std::vector<vec3> center;         // m
    std::vector<vec3> normal;         // unit; clusters: area-weighted mean, may be 0
    std::vector<float> area;          // m2
    std::vector<float> radius;        // m, of the bounding sphere about the centre
    std::vector<float> cone_cosine;   // all normals below lie within this cosine of `normal`
    std::vector<float> exposed;       // share of the area outside of solids, 0..1
    std::vector<std::uint16_t> exposed_mask;  // leaves: bit 4 j + i set = stratum (i, j) of the 4 x
                                              // 4 strata of patch_point's samples lies outside

    std::vector<NodeId> leaves;        // #leaves, ascending
    std::vector<NodeId> surface_node;  // #surfaces: the node that is the whole surface

    // Lookup: both sides of every triangle.
    std::vector<std::array<SurfaceId, 2>>
        triangle_surface;  // #triangles: front, back; kNone: unlit

    [[nodiscard]] std::size_t size() const { return parent.size(); }
    [[nodiscard]] bool is_cluster(NodeId n) const {
        return surface[static_cast<std::size_t>(n)] == kNone;
    }
    [[nodiscard]] bool is_leaf(NodeId n) const {
        return subtree_end[static_cast<std::size_t>(n)] == n + 1;
    }
    [[nodiscard]] bool emits_only(NodeId n) const;

    // World position of (u, v) of a surface: bilinear (quads) or barycentric (triangles).
    [[nodiscard]] vec3 surface_point(SurfaceId s, const vec2& uv) const;
    // World corners of a patch node; the surface's corner_count of them are set.
    [[nodiscard]] std::array<vec3, 4> patch_corners(NodeId n) const;
    [[nodiscard]] int corner_count(NodeId n) const;
    // Point of a patch for a sample of the unit square, uniform by area (up to a quad's shear).
    [[nodiscard]] vec3 patch_point(NodeId n, const vec2& sample) const;

    // The leaf patch that holds `point` on one side of a triangle; kNone: that side is unlit.
    // The interface that every later stage uses; it does not depend on how patches are made.
    [[nodiscard]] NodeId lookup(TriangleId triangle, bool back_side, const vec3& point) const;
};

}  // namespace antiradiance
