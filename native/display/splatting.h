// SPDX-License-Identifier: GPL-3.0-or-later
// Image-space splatting (Dachsbacher et al. 2007): every leaf is drawn as a disk larger than itself
// whose weight falls off from its centre, and a fragment takes the weighted mean of the disks that
// cover it and lie in about its plane. Smooth without a mesh; shadows blur over a patch's size.
#pragma once

#include <span>
#include <vector>

#include "base/progress.h"
#include "display/fragment_groups.h"
#include "display/source_lists.h"
#include "hierarchy/patch_tree.h"

namespace antiradiance {

struct SplattingInput {
    const PatchTree& tree;
    std::span<const vec3> irradiance;  // #nodes, W/m2, read at leaves
    const GBuffer& buffer;
    const FragmentGroups& groups;
    const SourceLists& disks;  // from find_disks()
};

// The leaves whose disks can reach each group.
[[nodiscard]] SourceLists find_disks(const PatchTree& tree, const FragmentGroups& groups,
                                     Progress& progress);

// Irradiance of every fragment, W/m2.  // #fragments
[[nodiscard]] std::vector<vec3> splat(const SplattingInput& input, Progress& progress,
                                      ProgressSpan span);

// What a fragment gets from the sums over its disks: their mean, or the value of its own leaf where
// no disk covers it.
[[nodiscard]] vec3 splatted_mean(const SplattingInput& input, const Fragment& fragment,
                                 const vec3& weighted_sum, float weights);

}  // namespace antiradiance
