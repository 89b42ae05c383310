// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/progress.h"
#include "pipeline/options.h"
#include "scene/scene.h"

namespace antiradiance {

// How far the antiradiance solution of a scene lies from operator G's on the same + links: what
// implicit visibility costs, apart from all errors of meshing.
struct VisibilityError {
    // Of the irradiance (direct and indirect) over all leaves, weighted by area and clipped at four
    // times the reference's median: rms(A - B) / mean(B) and mean(A) / mean(B) - 1.
    double relative_rms = 0;
    double bias = 0;
    bool converged = false;    // both solutions
    float least_radiance = 0;  // W/(m2 sr), of both solutions
    std::size_t leaves = 0;
    std::size_t links = 0;  // + and -, of the antiradiance solution
};

// Solves the scene with IMPLICIT visibility, then once more with every + link weighted by
// `rays_per_link` rays and no - links. Options::visibility is not read. Throws as
// Session::render() does; `scene` is validated (and cleaned) first.
[[nodiscard]] VisibilityError compare_visibility(Scene scene, Options options, int rays_per_link,
                                                 Progress& progress);

}  // namespace antiradiance
