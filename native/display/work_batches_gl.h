// SPDX-License-Identifier: GPL-3.0-or-later
// Fragment groups and their lists of nodes, cut into what one work group does at a time and into
// batches that fit into the device's buffers.
#pragma once

#include <span>
#include <vector>

#include "display/display_layout_gl.h"
#include "display/fragment_groups.h"
#include "display/source_lists.h"

namespace antiradiance {

struct WorkBatch {
    std::vector<glsl::WorkItem> items;
    std::uint32_t first_fragment = 0;  // into FragmentGroups::order
    std::uint32_t fragment_count = 0;
    std::span<const NodeId> lists;  // of the items' groups, borrowed
    std::uint32_t longest_list = 0;

    // Pairs of a fragment and a node at places [first, first + count) of the lists of one item.
    [[nodiscard]] static double pairs(const glsl::WorkItem& item, std::uint32_t first,
                                      std::uint32_t count);
    [[nodiscard]] double pairs() const;  // all
};

// block_bytes: of the largest buffer. A batch holds one item at least. `groups` cover all of their
// order, as tile_groups() and receiver_groups() do.
[[nodiscard]] std::vector<WorkBatch> make_batches(const FragmentGroups& groups,
                                                  const SourceLists& lists,
                                                  std::size_t block_bytes);

}  // namespace antiradiance
