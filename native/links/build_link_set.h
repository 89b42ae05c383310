// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "base/progress.h"
#include "hierarchy/patch_tree.h"
#include "links/link_set.h"
#include "links/refine.h"

namespace antiradiance {

// Sorts raw links (node numbers of `tree`) by bin, receiver along the bin's axis and source, and
// adds the tables that the solvers need. Links whose form factor is 0 (occluded, or removed) are
// dropped.
LinkSet build_link_set(const PatchTree& tree, const DirectionBins& bins,
                       std::span<const RawLink> links, Progress& progress);

}  // namespace antiradiance
