// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages.h"

#include "furnished_room.h"
#include "scene/validate.h"

namespace antiradiance::bench {

namespace {

constexpr float kPatchSize = 0.3F;  // m

Options options_of(Visibility visibility) {
    Options options;
    options.visibility = visibility;
    options.max_patch_size = kPatchSize;
    return options;
}

Scene valid_room() {
    Scene scene = make_furnished_room();
    validate(scene);
    return scene;
}

std::unique_ptr<DirectLight> direct_light_of(const Scene& scene, const RayScene& rays,
                                             DirectLightMode mode) {
    Progress progress;
    return std::make_unique<DirectLight>(scene, rays, mode, progress);
}

Model model_of(const Scene& scene, const Options& options) {
    Progress progress;
    return build_model(scene, options, progress);
}

}  // namespace

Stages::Stages(Visibility visibility)
    : options(options_of(visibility)),
      scene(valid_room()),
      model(model_of(scene, options)),
      direct(direct_light_of(scene, model.rays, options.direct_light)) {
    Progress progress;
    input = make_transport_input(scene, model.tree, direct->leaf_irradiance(model.tree, progress),
                                 options.direct_light);
}

const Stages& stages(Visibility visibility) {
    static const std::array<std::unique_ptr<Stages>, 2> made{
        std::make_unique<Stages>(Visibility::kImplicit),
        std::make_unique<Stages>(Visibility::kExplicit)};
    return *made[static_cast<std::size_t>(visibility)];
}

}  // namespace antiradiance::bench
