// SPDX-License-Identifier: GPL-3.0-or-later
// Patch trees without link refinement.
#pragma once

#include "hierarchy/growing_tree.h"
#include "hierarchy/surfaces.h"

namespace antiradiance::test {

// The front of every polygon.
inline std::vector<Surface> front_surfaces(const Scene& scene) {
    std::vector<Surface> surfaces;
    for (const Polygon& polygon : make_polygons(scene))
        surfaces.push_back(make_surface(scene, polygon, false));
    return surfaces;
}

// The front of every polygon, cut until no edge is longer than max_edge (m); nothing is buried.
inline PatchTree front_tree(const Scene& scene, float max_edge) {
    GrowingTree growing(front_surfaces(scene));
    growing.split_to(max_edge);
    std::vector<NodeId> renumbered;
    return growing.finish(scene, renumbered);
}

// The leaves of one object.
inline std::vector<NodeId> leaves_of(const PatchTree& tree, std::int32_t object) {
    std::vector<NodeId> leaves;
    for (const NodeId leaf : tree.leaves) {
        const auto surface = static_cast<std::size_t>(tree.surface[static_cast<std::size_t>(leaf)]);
        if (tree.surfaces[surface].object == object) leaves.push_back(leaf);
    }
    return leaves;
}

// The leaves on the front of their triangles.
inline std::vector<NodeId> front_leaves(const PatchTree& tree) {
    std::vector<NodeId> leaves;
    for (const NodeId leaf : tree.leaves) {
        const auto surface = static_cast<std::size_t>(tree.surface[static_cast<std::size_t>(leaf)]);
        if (!tree.surfaces[surface].back_side) leaves.push_back(leaf);
    }
    return leaves;
}

// Area-weighted mean over leaves of values per node.
inline vec3 area_mean(const PatchTree& tree, const std::vector<NodeId>& leaves,
                      const std::vector<vec3>& values) {
    vec3 sum(0);
    float area = 0;
    for (const NodeId leaf : leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        sum += values[n] * tree.area[n];
        area += tree.area[n];
    }
    return sum / area;
}

}  // namespace antiradiance::test
