// SPDX-License-Identifier: GPL-3.0-or-later
// The points that stand for all emitters in shadow maps, and the light from what a receiver sees of
// them.
//
// An emitter's light is its exact unshadowed irradiance times the visible share of its points,
// weighted by the light that each brings. Among many emitters a bounded number is chosen by power,
// in an even spread over the scene, and stands for the others (Keller, "Instant Radiosity", 1997).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "solve/direct_light.h"
#include "solve/direct_light_emitter.h"

namespace antiradiance {

class EmitterPoints {
public:
    // Borrows the emitters of `light`.
    EmitterPoints(const DirectLight::Impl& light, const Scene& scene);

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
    // Tells whether a point lights anything.
    using Filter = std::function<bool(const EmitterPoint&)>;
    void add(const Emitter& emitter, std::uint32_t count, float share, const Filter& filter);
    void add_each(std::span<const Emitter* const> emitters, const Filter& filter);
    void add_by_power(std::span<const Emitter* const> emitters, std::uint32_t choices,
                      const Filter& filter);

    std::vector<EmitterPoint> points_;  // of suns last
    std::vector<Group> groups_;
};

}  // namespace antiradiance
