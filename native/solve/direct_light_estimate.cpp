// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/direct_light_estimate.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace antiradiance {

namespace {

// Errors are measured as if rays were independent. Points of a low-discrepancy sequence do better:
// half of it is still on the safe side for a shadow edge from 16 rays on.
constexpr double kSequenceGain = 0.5;

ReceiverBounds bounds_of(std::span<const SurfacePoint> points) {
    ReceiverBounds b;
    for (const SurfacePoint& p : points) {
        b.center += p.position / static_cast<float>(points.size());
        b.normal += p.shading_normal;
    }
    const float length = glm::length(b.normal);
    b.normal = length > 0 ? b.normal / length : points[0].shading_normal;
    for (const SurfacePoint& p : points) {
        b.radius = std::max(b.radius, glm::distance(p.position, b.center));
    }
    return b;
}

bool are_alike(std::span<const SurfacePoint> points, const vec3& normal) {
    constexpr float kCosine = 0.999F;  // 2.6 degrees
    return std::all_of(points.begin(), points.end(), [&](const SurfacePoint& p) {
        return glm::dot(p.shading_normal, normal) >= kCosine;
    });
}

}  // namespace

IrradianceEstimate::IrradianceEstimate(const DirectLight::Impl& light,
                                       std::span<const SurfacePoint> points, std::uint32_t seed,
                                       std::uint32_t hemisphere_rays)
    : light_(light),
      seed_(seed),
      receivers_(bounds_of(points)),
      flat_(are_alike(points, receivers_.normal)),
      hemisphere_rays_(hemisphere_rays),
      batch_(light.rays) {
    sums_.reserve(light.always.size());
    for (const std::int32_t emitter : light.always)
        add_sum(emitter);
    if (light.in_tree.empty()) return;
    chosen_active_ = true;
    chosen_.assign(light.lights.size(), vec3(0));
    light.tree.choose(receivers_, kChoices, 0.5F, choices_);
    for (const EmitterChoice& choice : choices_) {
        if (choice.probability * kChoices < kOwnRays) continue;
        add_sum(light.in_tree[static_cast<std::size_t>(choice.emitter)]);
    }
}

void IrradianceEstimate::add_sum(std::int32_t index) {
    Sum& sum = sums_.emplace_back();
    sum.emitter = index;
    const Emitter& emitter = *light_.emitters[static_cast<std::size_t>(index)];
    if (!flat_ || emitter.at_infinity()) return;
    const EmitterBounds bounds = emitter.bounds();
    const float distance = glm::distance(receivers_.center, bounds.center) - bounds.radius;
    sum.far = receivers_.radius * kFar < distance;
    if (sum.far)
        sum.of_centre =
            emitter.unshadowed({receivers_.center, receivers_.normal, receivers_.normal});
}

void IrradianceEstimate::add_own(Sum& sum, std::span<const SurfacePoint> points) {
    const Emitter& emitter = *light_.emitters[static_cast<std::size_t>(sum.emitter)];
    const std::uint32_t seed = hash_combine(seed_, static_cast<std::uint32_t>(sum.emitter));
    batch_.clear();
    for (const SurfacePoint& point : points) {
        const std::uint32_t index = sum.rays++;
        const float unshadowed = sum.far ? sum.of_centre : emitter.unshadowed(point);
        if (unshadowed <= 0) continue;
        sum.unshadowed += unshadowed;
        sum.unshadowed2 += static_cast<double>(unshadowed) * unshadowed;
        const LightSample sample = emitter.sample(point, r2_sample(index, seed));
        sum.open += static_cast<double>(sample.weight) * luminance(sample.radiance);
        batch_.add(point, sample);
    }
    batch_.trace();
    for (const LightSample& sample : batch_.samples()) {
        const double y = static_cast<double>(sample.weight) * luminance(sample.radiance);
        const double w = sample.weight;
        sum.weight += w;
        sum.arrived += sample.weight * sample.radiance;
        sum.yy += y * y;
        sum.yw += y * w;
        sum.ww += w * w;
    }
}

// Balance heuristic: the part of a direction's light that samples of chosen emitters count.
// probability: of the emitter; density: of its own samples, 1/sr, 0: only they reach it.
float IrradianceEstimate::share_of_choice(const SurfacePoint& point, const vec3& direction,
                                          double probability, float density) const {
    if (density <= 0 || hemisphere_rays_ == 0) return 1;
    const float cosine = std::max(0.0F, glm::dot(direction, point.shading_normal));
    const float by_choice = kChoices * static_cast<float>(probability) * density;
    const float by_cosine = static_cast<float>(hemisphere_rays_) * cosine * kInvPi;
    return by_choice / (by_choice + by_cosine);
}

void IrradianceEstimate::sample_choices(std::span<const SurfacePoint> points, std::uint32_t pass,
                                        SampleSum& samples) {
    const std::uint32_t seed = hash_combine(seed_, 0x7f4a7c15U);
    batch_.clear();
    for (const EmitterChoice& choice : choices_) {
        if (choice.probability * kChoices >= kOwnRays) continue;
        const auto index = light_.in_tree[static_cast<std::size_t>(choice.emitter)];
        const Emitter& emitter = *light_.emitters[static_cast<std::size_t>(index)];
        for (std::uint32_t i = choice.begin; i < choice.end; ++i) {
            // A stride that is coprime to every number of points: neighbours in the tree are lit
            // from different points.
            const std::uint32_t turn = i * 37U + pass;
            const SurfacePoint& point = points[turn % points.size()];
            if (emitter.unshadowed(point) <= 0) continue;
            LightSample s = emitter.sample(point, r2_sample(pass * kChoices + i, seed));
            if (s.weight <= 0) continue;
            const float share = share_of_choice(point, s.direction, choice.probability,
                                                emitter.density(point, s.direction));
            s.weight *= share / static_cast<float>(choice.probability);
            s.light = light_.light_of[static_cast<std::size_t>(index)];
            batch_.add(point, s);
        }
    }
    batch_.trace();
    for (const LightSample& s : batch_.samples()) {
        samples.add(s.weight * s.radiance);
        add_chosen_sample(s.light, s.weight * s.radiance, kChoices);
    }
}

void IrradianceEstimate::add_chosen_sample(std::int32_t light, const vec3& irradiance,
                                           std::uint32_t count) {
    chosen_[static_cast<std::size_t>(light)] += irradiance / static_cast<float>(count);
}

// The light of the tree's emitters along a direction, pi L W/m2, by the share that the hemisphere's
// samples count of it.
IrradianceEstimate::Arriving IrradianceEstimate::arriving_from(const SurfacePoint& point,
                                                               const vec3& direction) const {
    if (glm::dot(direction, point.normal) <= 0) return {};
    const vec3 origin = point.position + point.normal * light_.rays.epsilon();
    const RayHit hit = light_.rays.intersect(origin, direction);
    if (!hit.hit()) return {};
    const std::int32_t in_tree = light_.of_triangle[static_cast<std::size_t>(hit.triangle)];
    if (in_tree == kNone) return {};
    const double probability = light_.tree.probability(receivers_, in_tree);
    if (probability * kChoices >= kOwnRays) return {};  // it has its own rays
    const auto index = static_cast<std::size_t>(light_.in_tree[static_cast<std::size_t>(in_tree)]);
    const Emitter& emitter = *light_.emitters[index];
    const float density = emitter.density(point, direction);
    if (density <= 0) return {};
    const float share = 1 - share_of_choice(point, direction, probability, density);
    return {light_.light_of[index], share * kPi * emitter.sample(point, vec2(0.5F)).radiance};
}

void IrradianceEstimate::sample_hemisphere(std::span<const SurfacePoint> points, std::uint32_t pass,
                                           SampleSum& samples) {
    const std::uint32_t seed = hash_combine(seed_, 0x3c6ef372U);
    for (std::uint32_t i = 0; i < hemisphere_rays_; ++i) {
        const std::uint32_t number = pass * kHemisphereRays + i;
        const SurfacePoint& point = points[number % points.size()];
        const Frame frame(point.shading_normal);
        const Arriving arriving =
            arriving_from(point, frame.to_world(cosine_hemisphere(r2_sample(number, seed))));
        samples.add(arriving.irradiance);
        if (arriving.light != kNone)
            add_chosen_sample(arriving.light, arriving.irradiance, hemisphere_rays_);
    }
}

void IrradianceEstimate::add_chosen(std::span<const SurfacePoint> points) {
    const std::uint32_t pass = chosen_passes_++;
    const float offset = r2_sample(pass, seed_ ^ 0x9d2c5680U).x;
    light_.tree.choose(receivers_, kChoices, offset, choices_);
    SampleSum by_choice;
    sample_choices(points, pass, by_choice);
    chosen_var_ += by_choice.variance(kChoices);
    if (hemisphere_rays_ == 0) return;
    SampleSum by_cosine;
    sample_hemisphere(points, pass, by_cosine);
    chosen_var_ += by_cosine.variance(hemisphere_rays_);
    // Each pass is unbiased by itself, whatever the last one decides for it.
    if (by_cosine.y <= 0) hemisphere_rays_ = 0;
}

void IrradianceEstimate::add(std::span<const SurfacePoint> points) {
    for (Sum& sum : sums_) {
        if (sum.active) add_own(sum, points);
    }
    if (chosen_active_) add_chosen(points);
}

void IrradianceEstimate::add_by_share(std::span<const SurfacePoint> points, std::size_t few) {
    if (few >= points.size()) {
        add(points);
        return;
    }
    double open = 0;
    for (Sum& sum : sums_) {
        add_own(sum, points.first(few));
        open += open_of(sum);
    }
    // By what could arrive: a choice by what does would not be fair to the rays that met nothing.
    // What reaches none of the few points, as past the rim of a spot, may reach others.
    for (Sum& sum : sums_) {
        const double share = open_of(sum);
        if (share <= 0 || share > kWeak * open) add_own(sum, points.subspan(few));
    }
    if (chosen_active_) add_chosen(points);
}

// Luminance of the irradiance if nothing were in the way.
double IrradianceEstimate::open_of(const Sum& sum) {
    return sum.weight > 0 ? sum.unshadowed / sum.rays * sum.open / sum.weight : 0;
}

vec3 IrradianceEstimate::mean_of(const Sum& sum) {
    if (sum.weight <= 0 || sum.rays == 0) return vec3(0);
    return sum.arrived * static_cast<float>(sum.unshadowed / sum.rays / sum.weight);
}

// Standard error of mean_of()'s luminance.
double IrradianceEstimate::error_of(const Sum& sum) {
    if (sum.weight <= 0 || sum.rays == 0) return 0;
    const double mean = sum.unshadowed / sum.rays;
    const double ratio = luminance(sum.arrived) / sum.weight;
    const double residual = sum.yy - 2 * ratio * sum.yw + ratio * ratio * sum.ww;
    // Where all rays arrive, the next might not: succession's mean of what n of n rays leave open.
    const double unseen = mean * ratio / (sum.rays + 2);
    const double shadow = std::max(unseen, mean * std::sqrt(std::max(0.0, residual)) / sum.weight);
    // The unshadowed part varies smoothly over a patch: with one point a cell, the error falls with
    // the number of points, not with its root.
    const double variance = std::max(0.0, sum.unshadowed2 / sum.rays - mean * mean);
    return kSequenceGain * shadow + ratio * std::sqrt(variance) / sum.rays;
}

bool IrradianceEstimate::refine(float allowed, int shadow_rays) {
    bool any = false;
    for (Sum& sum : sums_) {
        const bool hidden = sum.weight > 0 && max_component(sum.arrived) <= 0;
        sum.active = sum.active && (hidden ? sum.rays < static_cast<std::uint32_t>(shadow_rays)
                                           : error_of(sum) > allowed);
        any = any || sum.active;
    }
    if (chosen_active_) {
        const double passes = chosen_passes_;
        chosen_active_ = kSequenceGain * std::sqrt(chosen_var_) / passes > allowed;
        any = any || chosen_active_;
    }
    return any;
}

vec3 IrradianceEstimate::mean() const {
    vec3 total(0);
    for (const Sum& sum : sums_)
        total += mean_of(sum);
    for (const vec3& of_light : chosen_)
        total += of_light / static_cast<float>(std::max(chosen_passes_, 1U));
    return total;
}

void IrradianceEstimate::split(std::span<vec3> shares) const {
    std::ranges::fill(shares, vec3(0));
    for (const Sum& sum : sums_) {
        const std::int32_t light = light_.light_of[static_cast<std::size_t>(sum.emitter)];
        shares[static_cast<std::size_t>(light)] += mean_of(sum);
    }
    for (std::size_t i = 0; i < chosen_.size(); ++i)
        shares[i] += chosen_[i] / static_cast<float>(std::max(chosen_passes_, 1U));
}

}  // namespace antiradiance
