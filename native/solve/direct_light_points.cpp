// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/direct_light_points.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "solve/direct_light_estimate.h"

namespace antiradiance {

namespace {

constexpr std::uint32_t kMostPoints = 256;  // of all emitters but suns
constexpr std::uint32_t kMostPointsEach = 128;
constexpr std::uint32_t kSunPoints = 16;
// More emitters than this share points; one that shines from both sides needs two.
constexpr std::size_t kMostEmitters = kMostPoints / 2;

// Share of the light of an emitter's points that arrives.
float visible_share(const Emitter& emitter, const SurfacePoint& receiver,
                    std::span<const EmitterPoint> points, std::span<const float> visibility) {
    float all = 0;
    float seen = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const EmitterPoint& p = points[i];
        const float weight = emitter.weight(receiver, p);
        const vec3 towards = p.is_sun() ? -p.axis : p.position - receiver.position;
        all += weight;
        if (glm::dot(towards, receiver.normal) > 0) seen += weight * visibility[i];
    }
    return all > 0 ? seen / all : 0;
}

// What to multiply an emitter's light by when it stands for `share` such emitters: near to a
// surface, for no more than fill the sky.
float scale_of(const Emitter& emitter, const SurfacePoint& receiver, float share) {
    if (share == 1) return 1;
    const float filled = emitter.unshadowed(receiver) / emitter.most_unshadowed();
    return share / (1 + (share - 1) * filled);
}

// Whether any of its light may leave the luminous mesh around it: from inside a ball, none does.
bool lights_something(const EmitterPoint& point, const Scene& scene, const RayScene& rays) {
    constexpr std::uint32_t kRays = 256;
    if (point.reach != kPi / 2) return true;  // no surface
    const Frame frame(point.axis);
    for (std::uint32_t i = 0; i < kRays; ++i) {
        const vec3 direction = frame.to_world(cosine_hemisphere(r2_sample(i, kPointSeed)));
        const RayHit hit = rays.intersect(point.position, direction);
        if (!hit.hit()) return true;
        const auto t = static_cast<std::size_t>(hit.triangle);
        const auto m = static_cast<std::size_t>(scene.triangle_material[t]);
        const Material& material = scene.materials[m];
        if (!material.emits() || max_component(material.albedo) > 0) return true;
    }
    return false;
}

}  // namespace

EmitterPoints::EmitterPoints(const DirectLight::Impl& light, const Scene& scene) {
    const auto at = [&](std::int32_t i) {
        return light.emitters[static_cast<std::size_t>(i)].get();
    };
    std::vector<const Emitter*> suns;
    std::vector<const Emitter*> others;
    for (const std::int32_t i : light.always)
        (at(i)->at_infinity() ? suns : others).push_back(at(i));
    // Neighbours in the tree are neighbours in the scene.
    for (const std::int32_t i : light.tree.emitters())
        others.push_back(at(light.in_tree[static_cast<std::size_t>(i)]));
    const Filter filter = [&](const EmitterPoint& point) {
        return lights_something(point, scene, light.rays);
    };
    if (others.size() <= kMostEmitters) {
        add_each(others, filter);
    } else {
        // Of a closed mesh often one side counts: then there is room for twice as many.
        add_by_power(others, kMostPoints, filter);
        if (points_.size() > kMostPoints) add_by_power(others, kMostPoints / 2, filter);
    }
    for (const Emitter* sun : suns)
        add(*sun, sun->is_point() ? 1 : kSunPoints, 1, filter);
}

void EmitterPoints::add(const Emitter& emitter, std::uint32_t count, float share,
                        const Filter& filter) {
    const auto begin = static_cast<std::uint32_t>(points_.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const EmitterPoint point = emitter.point(i);
        if (filter(point)) points_.push_back(point);
    }
    const auto end = static_cast<std::uint32_t>(points_.size());
    if (end > begin) groups_.push_back({&emitter, begin, end, share});
}

void EmitterPoints::add_each(std::span<const Emitter* const> emitters, const Filter& filter) {
    const std::size_t each = kMostPoints / std::max<std::size_t>(emitters.size(), 1);
    const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(each, kMostPointsEach));
    for (const Emitter* emitter : emitters)
        add(*emitter, emitter->is_point() ? 1 : count, 1, filter);
}

// In place of what there is.
void EmitterPoints::add_by_power(std::span<const Emitter* const> emitters, std::uint32_t choices,
                                 const Filter& filter) {
    points_.clear();
    groups_.clear();
    double power = 0;
    for (const Emitter* emitter : emitters)
        power += emitter->bounds().power;
    // Choice k falls on the emitter in whose stretch of the power's sum k + 1/2 lies.
    double end = 0;
    for (const Emitter* emitter : emitters) {
        const double expected = emitter->bounds().power / power * choices;
        const double begin = end;
        end += expected;
        const double chosen = std::floor(end + 0.5) - std::floor(begin + 0.5);
        if (chosen == 0) continue;
        const auto count = static_cast<std::uint32_t>(2 * chosen);  // for both sides
        add(*emitter, emitter->is_point() ? 1 : count, static_cast<float>(chosen / expected),
            filter);
    }
}

vec3 EmitterPoints::irradiance(const SurfacePoint& receiver,
                               std::span<const float> visibility) const {
    vec3 total(0);
    for (const Group& g : groups_) {
        const std::uint32_t count = g.end - g.begin;
        const float share =
            visible_share(*g.emitter, receiver, std::span(points_).subspan(g.begin, count),
                          visibility.subspan(g.begin, count));
        if (share <= 0) continue;
        total +=
            share * scale_of(*g.emitter, receiver, g.share) * g.emitter->unshadowed_light(receiver);
    }
    return total;
}

}  // namespace antiradiance
