// SPDX-License-Identifier: GPL-3.0-or-later
// Blender's lamps in radiometric units, as Cycles 3.4 renders them (each measured; the tests of
// direct light hold the figures).
#pragma once

#include <array>

#include "scene/scene.h"

namespace antiradiance {

// W/sr of a point or spot lamp along its axis: power / 4 pi.
[[nodiscard]] vec3 lamp_intensity(const Lamp& lamp);

// 0..1: the share of the intensity that a spot sends along `direction` (unit, away from the lamp).
[[nodiscard]] float spot_falloff(const Lamp& lamp, const vec3& direction);

// Unit vector along which a spot, sun or area lamp shines: its local -z.
[[nodiscard]] vec3 lamp_direction(const Lamp& lamp);
[[nodiscard]] inline vec3 lamp_position(const Lamp& lamp) {
    return vec3(lamp.to_world[3]);
}

// m, world space: from the centre of an area lamp to the middle of its sides along local x and y.
struct AreaAxes {
    vec3 x{0}, y{0};
    // m2 of the rectangle or ellipse
    [[nodiscard]] float area(AreaShape shape) const;
};
[[nodiscard]] AreaAxes area_lamp_axes(const Lamp& lamp);
// m, counter-clockwise seen from where it shines; of an ellipse the rectangle around it.
[[nodiscard]] std::array<vec3, 4> area_lamp_corners(const Lamp& lamp);
// W/(m2 sr) of an area lamp along its axis: power / (4 area). A diffuse emitter of that power would
// have power / (pi area): Blender's area lamp is weaker by pi / 4.
[[nodiscard]] vec3 area_lamp_radiance(const Lamp& lamp);
// Factor on the radiance for a direction (unit, away from the lamp) when spread < pi: the light
// that passes a grid of slats, normalised to keep the power. 1 where spread is pi.
[[nodiscard]] float area_lamp_spread(const Lamp& lamp, const vec3& direction);

}  // namespace antiradiance
