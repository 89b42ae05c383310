// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "hierarchy/patch_tree.h"
#include "links/link_set.h"

namespace antiradiance {

// Visibility as coarse as the direction bins: a receiver keeps the + link to the nearest source of
// each bin and no other, and none where a patch above it keeps one to a nearer source (Dong et al.
// 2007, "Interactive Global Illumination Using Implicit Visibility"). For comparisons: where
// several patches share a bin, the light of all but one is lost.
// Distances are those of centres. #links, 1: goes, every - link among them.
[[nodiscard]] std::vector<std::uint8_t> all_but_shortest(const PatchTree& tree,
                                                         const LinkSet& links, Progress& progress);

}  // namespace antiradiance
