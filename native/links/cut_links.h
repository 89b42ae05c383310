// SPDX-License-Identifier: GPL-3.0-or-later
// Which links blocking planes cut: those of either sign whose segment between centres crosses one.
#pragma once

#include <span>
#include <vector>

#include "base/progress.h"
#include "hierarchy/patch_tree.h"
#include "links/blocking_planes.h"
#include "links/link_set.h"
#include "links/refine.h"

namespace antiradiance {

// #links: the first plane on the link's way from its source, or kNone.
[[nodiscard]] std::vector<BlockerId> find_cut_links(const PatchTree& tree,
                                                    std::span<const RawLink> links,
                                                    const BlockingPlanes& planes,
                                                    Progress& progress);
[[nodiscard]] std::vector<BlockerId> find_cut_links(const PatchTree& tree, const LinkSet& links,
                                                    const BlockingPlanes& planes,
                                                    Progress& progress);

}  // namespace antiradiance
