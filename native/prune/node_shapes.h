// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "hierarchy/patch_tree.h"

namespace antiradiance {

// World corners of all patches, and the patches that a cluster stands for: a tree computes both
// anew for each question.
class NodeShapes {
public:
    explicit NodeShapes(const PatchTree& tree);

    [[nodiscard]] std::span<const vec3> corners(NodeId patch) const {
        const Shape& s = shapes_[static_cast<std::size_t>(patch)];
        return {s.corners.data(), s.count};
    }
    // A patch: itself; a cluster: all surfaces below it.
    [[nodiscard]] std::span<const NodeId> members(NodeId n) const;

    [[nodiscard]] std::size_t bytes() const;

private:
    struct Shape {
        std::array<vec3, 4> corners;
        std::size_t count = 0;  // 0: a cluster
    };
    struct Range {
        std::uint32_t begin, end;  // into members_
    };
    std::vector<Shape> shapes_;    // #nodes
    std::vector<NodeId> members_;  // surfaces in preorder, then all nodes
    std::vector<Range> range_of_;  // #nodes
};

}  // namespace antiradiance
