// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/show.h"

namespace antiradiance {

DisplayRun show(const SolvedScene& solved, const Camera& camera, const DisplayOptions& options,
                const PictureQuality& quality, ChosenDisplay& display, Progress& progress) {
    const StageInput& input = *solved.input;
    const Model& model = *solved.model;
    return display.make_picture(
        input.options.solver,
        {input.scene, camera, model.rays, model.planes, model.tree, solved.links(),
         solved.pruned ? &solved.pruned->links : nullptr, *solved.direct, *solved.leaf_direct,
         solved.light->irradiance, solved.light->radiance, input.film_transparent,
         quality.samples_per_axis, quality.direct_of_leaves},
        options, progress);
}

}  // namespace antiradiance
