// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "base/progress.h"
#include "pipeline/options.h"
#include "pipeline/solution_error.h"
#include "scene/scene.h"

namespace antiradiance {

// Of the solution with one setting of Options::visibility.
struct VisibilityError : SolutionError {
    std::size_t leaves = 0;
    std::size_t links = 0;  // + and -, that were solved
    std::size_t rays = 0;   // that tested links
    double seconds = 0;     // for visibility, row normalisation and the solution
};

// Solves the scene in each of several ways, which differ in `visibility` and its rays, over the
// link mesh that the first of them makes in IMPLICIT: against operator G's solution on the same
// mesh, whose + links `reference` weighs. Pruning takes part where the way asks for it. Throws as
// Session::render() does; `scene` is validated (and cleaned) first.
[[nodiscard]] std::vector<VisibilityError> compare_visibility(Scene scene,
                                                              std::span<const Options> ways,
                                                              const ReferenceRays& reference,
                                                              Progress& progress);

}  // namespace antiradiance
