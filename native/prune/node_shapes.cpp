// SPDX-License-Identifier: GPL-3.0-or-later
#include "prune/node_shapes.h"

#include <algorithm>

namespace antiradiance {

NodeShapes::NodeShapes(const PatchTree& tree)
    : shapes_(tree.size()),
      members_(tree.surface_node.begin(), tree.surface_node.end()),
      range_of_(tree.size()) {
    std::sort(members_.begin(), members_.end());
    const auto surfaces = members_.size();
    const auto place = [&](NodeId n) {
        const auto end = members_.begin() + static_cast<std::ptrdiff_t>(surfaces);
        return static_cast<std::uint32_t>(std::lower_bound(members_.begin(), end, n) -
                                          members_.begin());
    };
    for (NodeId n = 0; n < static_cast<NodeId>(tree.size()); ++n) {
        const auto i = static_cast<std::size_t>(n);
        members_.push_back(n);
        if (tree.is_cluster(n)) {
            range_of_[i] = {place(n), place(tree.subtree_end[i])};
        } else {
            const auto self = static_cast<std::uint32_t>(surfaces + i);
            range_of_[i] = {self, self + 1};
            shapes_[i] = {tree.patch_corners(n), static_cast<std::size_t>(tree.corner_count(n))};
        }
    }
}

std::span<const NodeId> NodeShapes::members(NodeId n) const {
    const Range& range = range_of_[static_cast<std::size_t>(n)];
    return std::span(members_).subspan(range.begin, range.end - range.begin);
}

std::size_t NodeShapes::bytes() const {
    return shapes_.size() * sizeof(Shape) + members_.size() * sizeof(NodeId) +
           range_of_.size() * sizeof(Range);
}

}  // namespace antiradiance
