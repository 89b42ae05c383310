// SPDX-License-Identifier: GPL-3.0-or-later
// Blender's lamp units in radiometric ones.
#pragma once

#include "scene/scene.h"

namespace antiradiance {

// m2, of an area lamp's surface in world space.
float area_lamp_area(const Lamp& lamp);

// W/(m2 sr), emitted by an area lamp without spread: power / (4 area). (Cycles' convention; a
// Lambertian surface of that power would have power / (pi area).)
vec3 area_lamp_radiance(const Lamp& lamp);

}  // namespace antiradiance
