// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/relight.h"

namespace antiradiance {

namespace {

vec3 strength(const Scene& scene, const LightSource& light) {
    return light.lamp != kNone ? scene.lamps[static_cast<std::size_t>(light.lamp)].power
                               : scene.materials[static_cast<std::size_t>(light.material)].emission;
}

// Of each colour; none where there is something now and nothing before.
std::optional<vec3> ratio(const vec3& was, const vec3& is) {
    vec3 result(1);
    for (int c = 0; c < 3; ++c) {
        if (was[c] == is[c]) continue;
        if (was[c] <= 0) return std::nullopt;
        result[c] = is[c] / was[c];
    }
    return result;
}

}  // namespace

std::optional<std::vector<vec3>> relight(const SolvedScene& solved, const StageInput& input) {
    const StageInput& was = *solved.input;
    const LightShares& shares = *solved.light_shares;
    if (shares.lights.empty() || !same_model_input(was, input) || !same_pruning_input(was, input) ||
        !same_but_strength_of_lights(was, input)) {
        return std::nullopt;
    }
    std::vector<vec3> irradiance(solved.leaf_direct->size(), vec3(0));
    for (std::size_t i = 0; i < shares.lights.size(); ++i) {
        const LightSource& light = shares.lights[i];
        const std::optional<vec3> scale =
            ratio(strength(was.scene, light), strength(input.scene, light));
        if (!scale) return std::nullopt;
        for (std::size_t n = 0; n < irradiance.size(); ++n)
            irradiance[n] += *scale * shares.irradiance[i][n];
    }
    return irradiance;
}

}  // namespace antiradiance
