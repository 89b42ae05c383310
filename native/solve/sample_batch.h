// SPDX-License-Identifier: GPL-3.0-or-later
// Light samples whose shadow rays are traced together.
#pragma once

#include <span>
#include <vector>

#include "scene/ray_scene.h"
#include "solve/direct_light_emitter.h"

namespace antiradiance {

class SampleBatch {
public:
    explicit SampleBatch(const RayScene& rays) : scene_(rays) {}

    // For another use; memory is kept.
    void clear();
    // Keeps a sample taken from `point`. Samples of one emitter from points side by side make
    // coherent packets.
    void add(const SurfacePoint& point, const LightSample& sample);
    // Traces the rays: radiance becomes 0 where something is in the way, or the sample lies below
    // the point's horizon.
    void trace();

    [[nodiscard]] std::span<const LightSample> samples() const { return samples_; }

private:
    const RayScene& scene_;
    std::vector<LightSample> samples_;
    std::vector<std::size_t> tested_;  // into samples_: those with a ray
    std::vector<ShadowRay> rays_;
    std::vector<std::uint8_t> blocked_;
};

}  // namespace antiradiance
