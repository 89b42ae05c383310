// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/progress.h"
#include "pipeline/options.h"
#include "pipeline/solution_error.h"
#include "scene/scene.h"

namespace antiradiance {

// Of the antiradiance solution of a scene.
struct VisibilityError : SolutionError {
    std::size_t leaves = 0;
    std::size_t links = 0;  // + and -
};

// Solves the scene with IMPLICIT visibility, then once more with every + link weighted by
// `rays_per_link` rays and no - links. Options::visibility is not read. Throws as
// Session::render() does; `scene` is validated (and cleaned) first.
[[nodiscard]] VisibilityError compare_visibility(Scene scene, Options options, int rays_per_link,
                                                 Progress& progress);

}  // namespace antiradiance
