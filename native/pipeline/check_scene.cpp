// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/check_scene.h"

#include "scene/validate.h"

namespace antiradiance {

namespace {

bool has_light(const Scene& scene) {
    for (const Lamp& lamp : scene.lamps) {
        if (max_component(lamp.power) > 0) return true;
    }
    for (const std::int32_t m : scene.triangle_material) {
        if (scene.materials[static_cast<std::size_t>(m)].emits()) return true;
    }
    return false;
}

}  // namespace

std::vector<std::string> check_scene(Scene& scene) {
    std::vector<std::string> warnings = validate(scene);
    if (!has_light(scene)) {
        warnings.emplace_back(
            "The scene has no light: add a lamp or a material with emission; the picture is black");
    }
    return warnings;
}

}  // namespace antiradiance
