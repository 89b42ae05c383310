// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/compare_visibility.h"

#include "pipeline/model.h"
#include "scene/validate.h"

namespace antiradiance {

VisibilityError compare_visibility(Scene scene, Options options, int rays_per_link,
                                   Progress& progress) {
    validate(scene);
    options.visibility = Visibility::kImplicit;
    const Model model = build_model(scene, options, progress);
    VisibilityError error;
    error.leaves = model.tree.leaves.size();
    error.links = model.links.links.size();
    if (error.leaves == 0) return error;
    const ReferenceSolution reference(scene, options, model, rays_per_link, progress);
    static_cast<SolutionError&>(error) = reference.error_of(model.links, progress);
    return error;
}

}  // namespace antiradiance
