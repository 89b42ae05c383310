// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "hierarchy/patch_tree.h"

namespace antiradiance {

// Fills inner nodes with the area-weighted mean of their leaves (Hanrahan, Salzman & Aupperle 1991,
// the "pull" half of push-pull). values: #nodes.
template <typename T>
void pull_area_average(const PatchTree& tree, std::span<T> values) {
    const std::size_t count = tree.size();
    // Preorder backwards: all children come before their parent.
    std::vector<float> area(count, 0);
    for (std::size_t n = 0; n < count; ++n) {
        if (!tree.is_leaf(static_cast<NodeId>(n))) values[n] = T(0);
    }
    for (std::size_t n = count; n-- > 0;) {
        if (tree.is_leaf(static_cast<NodeId>(n))) {
            area[n] = tree.area[n];
        } else if (area[n] > 0) {
            values[n] /= area[n];
        }
        if (n == 0) break;
        const auto p = static_cast<std::size_t>(tree.parent[n]);
        values[p] += values[n] * area[n];
        area[p] += area[n];
    }
}

// Adds every node's value to all leaves below it and clears the inner ones (the "push" half).
template <typename T>
void push_sum(const PatchTree& tree, std::span<T> values) {
    for (std::size_t n = 1; n < tree.size(); ++n)
        values[n] += values[static_cast<std::size_t>(tree.parent[n])];
    for (std::size_t n = 0; n < tree.size(); ++n) {
        if (!tree.is_leaf(static_cast<NodeId>(n))) values[n] = T(0);
    }
}

}  // namespace antiradiance
