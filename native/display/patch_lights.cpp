// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/patch_lights.h"

#include "base/random.h"
#include "links/visibility.h"

namespace antiradiance {

namespace {

// By the place in its surface: a patch keeps its points when others come or go.
std::uint32_t seed_of(const PatchTree& tree, std::size_t n) {
    if (tree.is_cluster(static_cast<NodeId>(n))) return hash_u32(static_cast<std::uint32_t>(n));
    const vec2 place = tree.region[n].corners[0];
    return hash_combine(static_cast<std::uint32_t>(tree.surface[n]),
                        hash_combine(static_cast<std::uint32_t>(place.x * 65536),
                                     static_cast<std::uint32_t>(place.y * 65536)));
}

// Black patches keep a chance, or a black cluster had no points.
std::vector<float> sent_light(std::span<const vec3> radiance) {
    constexpr float kLeast = 1e-6F;
    std::vector<float> weight(radiance.size());
    for (std::size_t n = 0; n < weight.size(); ++n)
        weight[n] = luminance(radiance[n]) + kLeast;
    return weight;
}

}  // namespace

PatchLights::PatchLights(const PatchTree& tree, std::span<const vec3> radiance, int samples)
    : samples_(samples),
      lights_(tree.size()),
      points_(tree.size() * static_cast<std::size_t>(samples)) {
    const SurfaceSampler sampler(tree, sent_light(radiance));
    for (std::size_t n = 0; n < tree.size(); ++n) {
        const auto id = static_cast<NodeId>(n);
        lights_[n].center = tree.center[n];
        lights_[n].radius = tree.radius[n];
        if (!tree.is_cluster(id)) {
            lights_[n].normal = tree.normal[n];
            lights_[n].area = tree.area[n];
            lights_[n].radiance = radiance[n];
        }
        const std::uint32_t seed = seed_of(tree, n);
        for (int i = 0; i < samples; ++i) {
            const SurfaceSampler::Sample sample =
                sampler.sample(id, r2_sample(static_cast<std::uint32_t>(i), seed));
            points_[n * static_cast<std::size_t>(samples) + static_cast<std::size_t>(i)] = {
                sample.point, sample.normal};
        }
    }
}

}  // namespace antiradiance
