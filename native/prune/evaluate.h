// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "hierarchy/patch_tree.h"
#include "links/link_set.h"
#include "prune/link_visibility.h"
#include "prune/prune.h"

namespace antiradiance {

// A row of the paper's Table 1 and, in `seconds`, of Table 2; links of both signs.
struct PruneEvaluation {
    std::size_t patches = 0;
    std::size_t links = 0;
    std::size_t explicit_test = 0;  // links that the reference removes
    std::size_t removed = 0;
    std::size_t incorrect = 0;           // removed, but not by the reference
    std::size_t incorrect_radiance = 0;  // those of them that are + links: light that is lost
    std::size_t not_removed = 0;         // removed by the reference alone
    double seconds = 0;
};

// 1 at the links that no ray gets through.  // #links
RemovedLinks invisible_links(std::span<const LinkVisibility> visibility);

// Compares what a rule removes with a reference: the invisible links (trace_visibility), or what
// the rule's oracle removes, as the paper does.
PruneEvaluation evaluate_pruning(const PatchTree& tree, const LinkSet& links,
                                 std::span<const std::uint8_t> removed,
                                 std::span<const std::uint8_t> reference, double seconds);

}  // namespace antiradiance
