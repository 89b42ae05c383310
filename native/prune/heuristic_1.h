// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "prune/link_visibility.h"
#include "prune/prune.h"

namespace antiradiance {

// What is known of the links beforehand. Empty: nothing.
struct KnownLinks {
    std::span<const std::uint8_t> gone = {};          // #links: 1 takes no part
    std::span<const LinkVisibility> visibility = {};  // #links: replaces the test of solid angles
};

// Algorithm 1: a + link from sender S to occluder O, a - link from O to R, and a + link from S to R
// that lie in one direction; the last two are removed. As printed its line 18 would disable the
// visible S -> O instead.
// The link from S may end at O or below it. The test: as seen from S, O or a patch above it fills a
// cone about its centre that encloses the cone of the bin of S -> R.
// Deterministic.
RemovedLinks find_blocked_triples(const PatchTree& tree, const LinkSet& links,
                                  PruneDirections directions, const KnownLinks& known,
                                  Progress& progress);

}  // namespace antiradiance
