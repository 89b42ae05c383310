// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "base/progress.h"
#include "display/fragment_groups.h"
#include "hierarchy/patch_tree.h"

namespace antiradiance {

// Image-space splatting (Dachsbacher et al. 2007): every leaf is drawn as a disk larger than itself
// whose weight falls off from its centre, and a fragment takes the weighted mean of the disks that
// cover it and lie in about its plane. Smooth without a mesh; shadows blur over a patch's size.
// irradiance: #nodes, W/m2, read at leaves. Result: #fragments.
[[nodiscard]] std::vector<vec3> splat(const PatchTree& tree, std::span<const vec3> irradiance,
                                      const GBuffer& buffer, const FragmentGroups& groups,
                                      Progress& progress, ProgressSpan span);

}  // namespace antiradiance
