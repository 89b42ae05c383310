// SPDX-License-Identifier: GPL-3.0-or-later
// GrowingTree -> PatchTree: preorder numbers.
#include <algorithm>

#include "hierarchy/growing_tree.h"

namespace antiradiance {

PatchTree GrowingTree::finish(const Scene& scene, std::vector<NodeId>& renumbered) const {
    PatchTree tree;
    const std::size_t count = nodes_.size();
    tree.surfaces = surfaces_;
    tree.parent.resize(count);
    tree.subtree_end.resize(count);
    tree.depth.resize(count);
    tree.surface.resize(count);
    tree.region.resize(count);
    tree.center.resize(count);
    tree.normal.resize(count);
    tree.area.resize(count);
    tree.radius.resize(count);
    tree.cone_cosine.resize(count);
    tree.exposed.assign(count, 1);
    tree.exposed_mask.assign(count, 0xFFFF);
    tree.surface_node.assign(surfaces_.size(), kNone);
    tree.triangle_surface.assign(scene.triangles.size(), {kNone, kNone});
    renumbered.assign(count, kNone);

    // Preorder: children go onto the stack in reverse.
    std::vector<NodeId> stack{kRoot};
    NodeId next = 0;
    while (!stack.empty()) {
        const NodeId old = stack.back();
        stack.pop_back();
        const GrowingNode& n = node(old);
        const NodeId id = next++;
        const auto i = static_cast<std::size_t>(id);
        renumbered[static_cast<std::size_t>(old)] = id;
        tree.parent[i] = n.parent == kNone ? kNone : renumbered[static_cast<std::size_t>(n.parent)];
        tree.depth[i] =
            n.parent == kNone ? 0 : tree.depth[static_cast<std::size_t>(tree.parent[i])] + 1;
        tree.subtree_end[i] = id + 1;
        tree.surface[i] = n.surface;
        tree.region[i] = n.region;
        tree.center[i] = n.center;
        tree.normal[i] = n.normal;
        tree.area[i] = n.area;
        tree.radius[i] = n.radius;
        tree.cone_cosine[i] = n.cone_cosine;
        if (n.surface != kNone) {
            NodeId& whole = tree.surface_node[static_cast<std::size_t>(n.surface)];
            if (whole == kNone) whole = id;
        }
        if (n.is_leaf()) tree.leaves.push_back(id);
        for (std::int32_t c = n.child_count; c-- > 0;)
            stack.push_back(n.first_child + c);
    }
    for (std::size_t i = count; i-- > 1;) {
        NodeId& end = tree.subtree_end[static_cast<std::size_t>(tree.parent[i])];
        end = std::max(end, tree.subtree_end[i]);
    }
    for (std::size_t s = 0; s < surfaces_.size(); ++s) {
        for (const TriangleId t : surfaces_[s].triangles) {
            if (t != kNone)
                tree.triangle_surface[static_cast<std::size_t>(t)][surfaces_[s].back_side ? 1 : 0] =
                    static_cast<SurfaceId>(s);
        }
    }
    return tree;
}

}  // namespace antiradiance
