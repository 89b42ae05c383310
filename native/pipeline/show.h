// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of a solved scene, from anywhere: nothing is solved again.
#pragma once

#include "base/progress.h"
#include "pipeline/choose_display.h"
#include "pipeline/solved_scene.h"
#include "scene/scene.h"

namespace antiradiance {

// How much work goes into a picture, beside its display options.
struct PictureQuality {
    int samples_per_axis = 4;       // anti-aliasing, n x n a pixel
    bool direct_of_leaves = false;  // see DisplayInput
};

// `options`: those of solved.input, or simpler ones; FINAL_SHOOTING with antiradiance needs links
// that were made for it. Throws Cancelled; std::runtime_error when the device fails.
DisplayRun show(const SolvedScene& solved, const Camera& camera, const DisplayOptions& options,
                const PictureQuality& quality, ChosenDisplay& display, Progress& progress);

}  // namespace antiradiance
