// SPDX-License-Identifier: GPL-3.0-or-later
// Final shooting (the paper's section 5): fragments lit by patch lights, radiance in front of each
// and antiradiance behind it.
#pragma once

#include <vector>

#include "base/progress.h"
#include "display/bin_weights.h"
#include "display/fragment_groups.h"
#include "display/patch_lights.h"
#include "display/source_lists.h"
#include "solve/antiradiance_table.h"

namespace antiradiance {

struct ShootingInput {
    const PatchTree& tree;
    const GBuffer& buffer;
    const FragmentGroups& groups;
    const SourceLists& sources;
    const PatchLights& lights;
    const AntiradianceTable& antiradiance;
    const BinWeights& bins;
    float epsilon;  // m, heights above a plane that rounding explains
    // n: pixel (x, y) of each n x n block takes every n^2-th source (Segovia et al. 2006); the
    // result is n^2 times as large and wants interleave_blur().
    int interleave = 1;
};

// Irradiance of every fragment, W/m2; may be negative by the antiradiance's error.  // #fragments
[[nodiscard]] std::vector<vec3> shoot(const ShootingInput& input, Progress& progress,
                                      ProgressSpan span);

}  // namespace antiradiance
