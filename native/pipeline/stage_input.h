// SPDX-License-Identifier: GPL-3.0-or-later
// What each stage of a render reads of the scene and the options. A stage's result can be kept when
// the function here that is named after it finds no difference, and all stages before it were kept.
//
// The values themselves are compared, not hashes of them: a wrong "the same" would be a wrong
// picture. Only what a stage reads counts, so that a lamp that is dimmed builds no new hierarchy.
#pragma once

#include "pipeline/options.h"
#include "scene/scene.h"

namespace antiradiance {

struct StageInput {
    Scene scene;  // valid (see validate())
    Options options;
    bool film_transparent = false;
    // Above 1, for a first look: patches are that many times as long, links carry that many times
    // squared as much, and between clusters where the visibility is EXPLICIT.
    float coarseness = 1;
};

// Whether links are pruned: EXPLICIT has tested each of them with rays.
[[nodiscard]] bool prunes(const Options& options);

[[nodiscard]] bool same_model_input(const StageInput& was, const StageInput& is);
[[nodiscard]] bool same_pruning_input(const StageInput& was, const StageInput& is);
[[nodiscard]] bool same_direct_light_input(const StageInput& was, const StageInput& is);
// Whether direct light differs by the strength and colour of lights alone, at most.
[[nodiscard]] bool same_but_strength_of_lights(const StageInput& was, const StageInput& is);
// Whether that is so, and nothing that emits has another shape or place.
[[nodiscard]] bool same_lights(const StageInput& was, const StageInput& is);
[[nodiscard]] bool same_transport_input(const StageInput& was, const StageInput& is);
[[nodiscard]] bool same_solve_input(const StageInput& was, const StageInput& is);
[[nodiscard]] bool same_evaluation_input(const StageInput& was, const StageInput& is);

// Whether no stage has to run again.
[[nodiscard]] bool same_solution_input(const StageInput& was, const StageInput& is);
// Whether pictures are the same as well, from one camera and the same solution.
[[nodiscard]] bool same_picture_input(const StageInput& was, const StageInput& is);

}  // namespace antiradiance
