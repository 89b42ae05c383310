// SPDX-License-Identifier: GPL-3.0-or-later
// What two states of a scene have in common, for whoever wants to keep what rays found in the
// earlier one: patches that are the same in both, and lines of sight that nothing which moved,
// came, went or changed its shape can have crossed, then or now.
#pragma once

#include <vector>

#include "base/box.h"
#include "hierarchy/patch_tree.h"

namespace antiradiance {

// Whether the convex hull of two boxes may meet a third one; false only if it does not.
[[nodiscard]] bool may_cross(const Box& from, const Box& to, const Box& obstacle);

class SceneChange {
public:
    // Copies what it needs. Objects are told apart by their name, and the k-th of a name is
    // compared with the k-th.
    SceneChange(const Scene& earlier, const PatchTree& earlier_tree, const Scene& now,
                const PatchTree& now_tree);

    // The node of the earlier tree with the place, shape and exposed share of node n of the present
    // one; kNone: there is none.
    [[nodiscard]] NodeId earlier(NodeId n) const { return earlier_[static_cast<std::size_t>(n)]; }
    // Around node n of the present tree.
    [[nodiscard]] const Box& box(NodeId n) const { return boxes_[static_cast<std::size_t>(n)]; }

    // Whether what changed may lie, or have lain, between a point of one box and one of the other.
    [[nodiscard]] bool may_be_between(const Box& from, const Box& to) const;
    // The same towards directions within an angle (rad) about a unit vector.
    [[nodiscard]] bool may_be_before_sky(const Box& from, const vec3& direction, float angle) const;

private:
    std::vector<Box> changed_;
    Box all_changed_;
    std::vector<NodeId> earlier_;  // #nodes of the present tree
    std::vector<Box> boxes_;       // #nodes of the present tree
};

}  // namespace antiradiance
