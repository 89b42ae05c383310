// SPDX-License-Identifier: GPL-3.0-or-later
// The points that stand for all emitters in shadow maps, and the light from what a receiver sees of
// them.
//
// An emitter's light is its exact unshadowed irradiance times the visible share of its points,
// weighted by the light that each brings. Among many emitters a bounded number is chosen by power,
// in an even spread over the scene, and stands for the others (Keller, "Instant Radiosity", 1997).
#pragma once

#include <span>
#include <vector>

#include "solve/direct_light.h"
#include "solve/direct_light_emitter.h"

namespace antiradiance {

class EmitterPoints {
public:
    // Borrows `light`.
    explicit EmitterPoints(const DirectLight::Impl& light);

    [[nodiscard]] std::span<const EmitterPoint> points() const { return points_; }
    // W/m2. visibility: of each point, 0..1
    [[nodiscard]] vec3 irradiance(const SurfacePoint& receiver,
                                  std::span<const float> visibility) const;

private:
    // Points [begin, end) of one emitter, which stands for `share` such emitters.
    struct Group {
        const Emitter* emitter;
        std::uint32_t begin, end;
        float share;
    };
    void add(const Emitter& emitter, std::uint32_t count, float share);
    void add_each(std::span<const std::int32_t> emitters);
    void add_by_power(std::span<const std::int32_t> emitters, std::uint32_t choices);
    [[nodiscard]] bool lights_something(const EmitterPoint& point) const;

    const DirectLight::Impl& light_;
    std::vector<EmitterPoint> points_;  // of suns last
    std::vector<Group> groups_;
};

}  // namespace antiradiance
