// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/sample_batch.h"

namespace antiradiance {

void SampleBatch::clear() {
    samples_.clear();
    tested_.clear();
    rays_.clear();
}

void SampleBatch::add(const SurfacePoint& point, const LightSample& sample) {
    LightSample& kept = samples_.emplace_back(sample);
    const bool is_dark = sample.weight <= 0 || max_component(sample.radiance) <= 0;
    if (is_dark || glm::dot(sample.direction, point.normal) <= 0) {
        kept.radiance = vec3(0);
        return;
    }
    const vec3 origin = point.position + point.normal * scene_.epsilon();
    const bool is_sun = sample.distance >= RayScene::kInfinity;
    tested_.push_back(samples_.size() - 1);
    rays_.push_back({origin, is_sun ? scene_.beyond(origin, sample.direction) : sample.target});
}

void SampleBatch::trace() {
    blocked_.resize(rays_.size());
    scene_.occluded(rays_, blocked_);
    for (std::size_t i = 0; i < tested_.size(); ++i) {
        if (blocked_[i]) samples_[tested_[i]].radiance = vec3(0);
    }
}

}  // namespace antiradiance
