// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/direct_light_points.h"

#include <algorithm>
#include <cmath>

#include "solve/direct_light_estimate.h"

namespace antiradiance {

namespace {

constexpr std::uint32_t kMostPoints = 256;  // of all emitters but suns
constexpr std::uint32_t kMostPointsEach = 64;
constexpr std::uint32_t kSunPoints = 16;
// Emitters beyond this share points: one that shines from both sides needs two.
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

}  // namespace

EmitterPoints::EmitterPoints(const DirectLight::Impl& light) {
    std::vector<std::int32_t> suns;
    std::vector<std::int32_t> others;
    for (const std::int32_t i : light.always) {
        const bool is_sun = light.emitters[static_cast<std::size_t>(i)]->at_infinity();
        (is_sun ? suns : others).push_back(i);
    }
    // Neighbours in the tree are neighbours in the scene.
    for (const std::int32_t i : light.tree.emitters())
        others.push_back(light.in_tree[static_cast<std::size_t>(i)]);
    add_some(light, others);
    for (const std::int32_t i : suns) {
        const Emitter& sun = *light.emitters[static_cast<std::size_t>(i)];
        add(sun, sun.is_point() ? 1 : kSunPoints, 1);
    }
}

void EmitterPoints::add(const Emitter& emitter, std::uint32_t count, float share) {
    const auto begin = static_cast<std::uint32_t>(points_.size());
    for (std::uint32_t i = 0; i < count; ++i)
        points_.push_back(emitter.point(i));
    groups_.push_back({&emitter, begin, begin + count, share});
}

void EmitterPoints::add_some(const DirectLight::Impl& light,
                             std::span<const std::int32_t> emitters) {
    const auto at = [&](std::int32_t i) -> const Emitter& {
        return *light.emitters[static_cast<std::size_t>(i)];
    };
    if (emitters.size() <= kMostEmitters) {
        const auto each = static_cast<std::uint32_t>(std::clamp<std::size_t>(
            kMostPoints / std::max<std::size_t>(emitters.size(), 1), 2, kMostPointsEach));
        for (const std::int32_t i : emitters)
            add(at(i), at(i).is_point() ? 1 : each, 1);
        return;
    }
    double power = 0;
    for (const std::int32_t i : emitters)
        power += at(i).bounds().power;
    // Choice k falls on the emitter in whose stretch of the power's sum k + 1/2 lies; both sides.
    constexpr double kChoices = kMostPoints / 2.0;
    double end = 0;
    for (const std::int32_t i : emitters) {
        const double expected = at(i).bounds().power / power * kChoices;
        const double begin = end;
        end += expected;
        const auto choices =
            static_cast<std::uint32_t>(std::floor(end + 0.5) - std::floor(begin + 0.5));
        if (choices > 0)
            add(at(i), at(i).is_point() ? 1 : 2 * choices, static_cast<float>(choices / expected));
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
