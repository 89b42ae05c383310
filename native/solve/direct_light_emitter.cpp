// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/direct_light_emitter.h"

#include "base/random.h"

namespace antiradiance {

Box Emitter::box() const {
    const EmitterBounds sphere = bounds();
    return {sphere.center - sphere.radius, sphere.center + sphere.radius};
}

vec3 Emitter::unshadowed_light(const SurfacePoint& receiver) const {
    constexpr std::uint32_t kColourSamples = 16;
    const float exact = unshadowed(receiver);
    if (exact <= 0) return vec3(0);
    if (!is_coloured()) return exact * sample(receiver, vec2(0.5F)).radiance;
    vec3 light(0);
    float weight = 0;
    for (std::uint32_t i = 0; i < kColourSamples; ++i) {
        const LightSample s = sample(receiver, r2_sample(i, kPointSeed));
        light += s.weight * s.radiance;
        weight += s.weight;
    }
    return weight > 0 ? exact / weight * light : vec3(0);
}

}  // namespace antiradiance
