// SPDX-License-Identifier: GPL-3.0-or-later
// Final shooting (the paper's section 5): each fragment is lit by the patches of its group's list.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "base/progress.h"
#include "display/fragment_groups.h"
#include "display/patch_shooter.h"
#include "display/source_lists.h"

namespace antiradiance {

struct ShootingInput {
    const PatchTree& tree;
    const GBuffer& buffer;
    const FragmentGroups& groups;
    const SourceLists& sources;
    std::span<const vec3> leaf_light;  // #nodes, W/m2, all that leaves get; tells strong patches
                                       // from weak ones
    // n: pixel (x, y) of each n x n block takes every n^2-th source (Segovia et al. 2006); the
    // result is n^2 times as large and wants interleave_blur().
    int interleave = 1;
};

using MakeShooter = std::function<std::unique_ptr<PatchShooter>()>;  // called from any thread

// Irradiance of every fragment, W/m2; may be negative by an antiradiance's error.  // #fragments
[[nodiscard]] std::vector<vec3> shoot(const ShootingInput& input, const MakeShooter& make_shooter,
                                      Progress& progress, ProgressSpan span);

// With antiradiance in place of rays, on any back end (display_backend.h).
struct AntiradianceShooting {
    const ShootingInput& shooting;
    const PatchLights& lights;
    const AntiradianceTable& antiradiance;
    const BinWeights& bins;
    float epsilon;  // m, heights above a plane that rounding explains
};
[[nodiscard]] std::vector<vec3> shoot(const AntiradianceShooting& input, Progress& progress,
                                      ProgressSpan span);

}  // namespace antiradiance
