// SPDX-License-Identifier: GPL-3.0-or-later
// What blocking planes do to a scene: which links they cut, rightly or not, and to the light.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "links/refine.h"
#include "pipeline/options.h"
#include "pipeline/solution_error.h"
#include "scene/scene.h"

namespace antiradiance {

struct BlockerEvaluation {
    LinkCount links;  // of IMPLICIT visibility, without planes
    struct Plane {
        std::string name;
        LinkCount cut;           // links for which it is the first plane on their way
        LinkCount occluded_cut;  // of those: no ray gets through
        // + links cut though no surface lies between the centres: light that the plane takes away,
        // as it does not lie inside of a wall there. Other links that rays get through are seen in
        // part, past an edge of the wall.
        std::size_t wrongly_cut = 0;
        bool helps = false;  // find_helpful_blockers(); with `light`
    };
    std::vector<Plane> per_plane;  // #Scene::blockers
    double seconds = 0;            // for finding what is cut

    std::optional<LinkCount> occluded;  // with `all_links`: how many no ray gets through
    // With `light`: of IMPLICIT's solution over all links and over those that the planes leave,
    // against ray-tested ones.
    std::optional<SolutionError> without_planes, with_planes;
};

struct BlockerEvaluationOptions {
    int rays = 64;           // a link that is cut; 0: it is counted, and that is all
    bool all_links = false;  // links that are not cut are tested as well
    bool light = false;      // the scene is solved
};

// Makes the link mesh of IMPLICIT visibility without the scene's planes, and cuts it. The
// `visibility` of `options` is not read. `scene` is validated (and cleaned) first. Throws as
// Session::render() does.
[[nodiscard]] BlockerEvaluation evaluate_blockers(Scene scene, Options options,
                                                  const BlockerEvaluationOptions& how,
                                                  Progress& progress);

}  // namespace antiradiance
