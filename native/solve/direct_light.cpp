// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/direct_light.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "solve/direct_light_estimate.h"
#include "solve/direct_light_maps.h"

namespace antiradiance {

std::vector<SurfacePoint> spread_choice(std::span<const SurfacePoint> points, std::size_t count) {
    if (points.size() <= count) return {points.begin(), points.end()};
    const std::size_t stretch = points.size() / count;
    std::vector<SurfacePoint> chosen;
    chosen.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        chosen.push_back(points[i * stretch + i % stretch]);
    return chosen;
}

std::vector<SurfacePoint> spread_first(std::span<const SurfacePoint> points, std::size_t count) {
    std::vector<SurfacePoint> ordered = spread_choice(points, count);
    if (ordered.size() == points.size()) return ordered;
    const std::size_t stretch = points.size() / count;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t place = i / stretch;
        if (place >= count || i % stretch != place % stretch) ordered.push_back(points[i]);
    }
    return ordered;
}

DirectLight::DirectLight(const Scene& scene, const RayScene& rays, DirectLightMode mode,
                         Progress& progress)
    : impl_(std::make_unique<Impl>(Impl{rays})) {
    const float epsilon = rays.epsilon();
    std::vector<EmitterPtr>& emitters = impl_->emitters;
    const auto add = [&](EmitterPtr emitter, const LightSource& source) {
        std::vector<LightSource>& lights = impl_->lights;
        const auto known = std::ranges::find(lights, source);
        impl_->light_of.push_back(static_cast<std::int32_t>(known - lights.begin()));
        if (known == lights.end()) lights.push_back(source);
        emitters.push_back(std::move(emitter));
    };
    for (std::size_t i = 0; i < scene.lamps.size(); ++i) {
        const Lamp& lamp = scene.lamps[i];
        if (mode == DirectLightMode::kImplicit && lamp.type == LampType::kArea) continue;
        if (EmitterPtr emitter = make_lamp_emitter(lamp, epsilon))
            add(std::move(emitter), {.lamp = static_cast<std::int32_t>(i)});
    }
    MeshEmitters mesh;
    if (mode != DirectLightMode::kImplicit) mesh = make_mesh_emitters(scene, epsilon);
    const std::size_t mesh_count = mesh.emitters.size();
    for (std::size_t i = 0; i < mesh_count; ++i)
        add(std::move(mesh.emitters[i]), {.material = mesh.material[i]});
    std::vector<EmitterBounds> bounds;
    for (std::size_t i = 0; i < emitters.size(); ++i) {
        const auto index = static_cast<std::int32_t>(i);
        if (emitters[i]->at_infinity()) {
            impl_->always.push_back(index);
        } else {
            impl_->in_tree.push_back(index);
            bounds.push_back(emitters[i]->bounds());
        }
    }
    if (bounds.size() <= kMostEmittersEach) {
        impl_->always.insert(impl_->always.end(), impl_->in_tree.begin(), impl_->in_tree.end());
        impl_->in_tree.clear();
    } else {
        impl_->tree = EmitterTree(bounds);
        impl_->of_triangle = std::move(mesh.of_triangle);
        const auto first = static_cast<std::int32_t>(bounds.size() - mesh_count);
        for (std::int32_t& number : impl_->of_triangle) {
            if (number != kNone) number += first;
        }
    }
    if (mode == DirectLightMode::kShadowMaps && any())
        impl_->mapped = std::make_unique<MappedLight>(*impl_, scene, progress);
}

DirectLight::~DirectLight() = default;

bool DirectLight::has_maps() const {
    return impl_->mapped != nullptr;
}

std::vector<vec3> DirectLight::mapped_irradiance(std::span<const SurfacePoint> points,
                                                 std::span<const std::uint32_t> ends,
                                                 Progress& progress, ProgressSpan span) const {
    return impl_->mapped->irradiance(points, ends, progress, span);
}

DirectLight::Maps DirectLight::maps() const {
    if (!has_maps()) return {};
    return {impl_->mapped->maps().image_count(), impl_->mapped->maps().bytes()};
}

bool DirectLight::any() const {
    return !impl_->emitters.empty();
}

vec3 DirectLight::irradiance(std::span<const SurfacePoint> points, const DirectSampling& sampling,
                             std::uint32_t seed) const {
    if (points.empty() || !any()) return vec3(0);
    IrradianceEstimate estimate(*impl_, points, seed);
    estimate.add_by_share(spread_first(points, kWeakRays), kWeakRays);
    const int most = DirectSampling::kMostFactor * sampling.samples;
    const auto count = static_cast<int>(points.size());
    int rays = count;
    while (rays < most) {
        if (rays >= sampling.samples) {
            const float direct = luminance(estimate.mean());
            const bool missing = direct < 0.5F * sampling.expected;
            const float allowed = sampling.tolerance * (direct + sampling.indirect);
            if (!estimate.refine(allowed, missing ? most : 0)) break;
        }
        const int goal = rays < sampling.samples ? sampling.samples : std::min(2 * rays, most);
        for (; rays < goal; rays += count)
            estimate.add(points);
    }
    return estimate.mean();
}

}  // namespace antiradiance
