// SPDX-License-Identifier: GPL-3.0-or-later
// Explicit and implicit visibility in one solution: Mückl & Dachsbacher, Eq. 7, with whole rows of
// the operator G (algorithm.md "MIXED by component").
#pragma once

#include <vector>

#include "base/progress.h"
#include "links/visibility.h"
#include "scene/ray_scene.h"
#include "solve/solver.h"

namespace antiradiance {

struct MixedOptions {
    float ray_budget = 0.25F;  // 0..1, of the rays that test all + links
    VisibilityRays rays;
};

struct MixedVisibility {
    LinkSet links;
    std::vector<float> row_scale;   // #nodes, of TransportProblem
    std::size_t rays = 0;           // traced between patches
    std::size_t explicit_rows = 0;  // segments of the implicit set that rays decide
    std::size_t implicit_rows = 0;
};

// A unit of decision is the topmost row (receiver, bin) that holds links, with all rows of that bin
// in its subtree: an occluder's - link may end on any level. A unit is implicit, with the links
// that it has, or explicit: each + link weighted by rays as apply_ray_visibility() does, and no -
// links. Single rows must not be decided: a row may hold the light that a - link of another row
// takes back.
//
// Which units become explicit: those that - links bring most of the light to, for the rays they
// cost, after a few bounces with implicit visibility; light on + links counts less than half as
// much. A larger budget takes the same units and more.
// With a budget of 0 the links are those of `implicit`; with 1 those of operator G, row
// normalisation included. implicit.links: of the IMPLICIT mode, pruned or not and cut by the
// planes; without clusters.
[[nodiscard]] MixedVisibility mix_visibility(const TransportProblem& implicit,
                                             const RayScene& scene, const BlockingPlanes& planes,
                                             const MixedOptions& options, Progress& progress);

}  // namespace antiradiance
