// SPDX-License-Identifier: GPL-3.0-or-later
// Visibility of a link set that is sorted already: which links share their rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hierarchy/patch_tree.h"
#include "links/link_set.h"
#include "links/visibility.h"

namespace antiradiance {

inline constexpr std::uint32_t kNoPair = 0xFFFFFFFF;

// The unordered pairs of nodes that + links join, ascending.
struct LinkPairs {
    std::vector<TestedPair> pairs;
    std::vector<std::uint32_t> of_link;  // #links: into pairs; kNoPair: a - link
};

[[nodiscard]] LinkPairs pair_links(const PatchTree& tree, const LinkSet& links);

// Operator G's rows: + links times the visibility of their pair (0..1, #pairs); returns what is
// left of no use there, - links and occluded ones.  // #links, 1: goes
// rows: #segments, 1: weighed; empty: all.
[[nodiscard]] std::vector<std::uint8_t> weigh_links(LinkSet& links, const LinkPairs& pairs,
                                                    std::span<const float> visibility,
                                                    std::span<const std::uint8_t> rows = {});

}  // namespace antiradiance
