// SPDX-License-Identifier: GPL-3.0-or-later
// Direct light by shadow maps: visibility from OpenGL, irradiance in closed form.
#pragma once

#include <span>
#include <vector>

#include "base/parallel.h"
#include "solve/direct_light.h"
#include "solve/direct_light_points.h"
#include "solve/shadow_maps_gl.h"

namespace antiradiance {

class MappedLight {
public:
    // Draws the maps of all emitters, of which there is one at least. Borrows the emitters of
    // `light`.
    MappedLight(const DirectLight::Impl& light, const Scene& scene, Progress& progress);

    // DirectLight::mapped_irradiance()
    [[nodiscard]] std::vector<vec3> irradiance(std::span<const SurfacePoint> points,
                                               std::span<const std::uint32_t> ends,
                                               Progress& progress, ProgressSpan span) const;
    [[nodiscard]] const ShadowMaps& maps() const { return maps_; }

private:
    EmitterPoints emitters_;
    ShadowMaps maps_;
};

}  // namespace antiradiance
