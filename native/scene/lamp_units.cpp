// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/lamp_units.h"

namespace antiradiance {

float area_lamp_area(const Lamp& lamp) {
    const vec3 x = vec3(lamp.to_world[0]) * lamp.size.x;
    const vec3 y = vec3(lamp.to_world[1]) * lamp.size.y;
    const float rectangle = glm::length(glm::cross(x, y));
    return lamp.shape == AreaShape::kEllipse ? kPi / 4 * rectangle : rectangle;
}

vec3 area_lamp_radiance(const Lamp& lamp) {
    const float area = area_lamp_area(lamp);
    return area > 0 ? lamp.power / (4 * area) : vec3(0);
}

}  // namespace antiradiance
