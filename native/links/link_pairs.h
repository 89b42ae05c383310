// SPDX-License-Identifier: GPL-3.0-or-later
// Visibility of a link set that is sorted already: which links share their rays.
#pragma once

#include <cstdint>
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

}  // namespace antiradiance
