// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "base/types.h"

namespace antiradiance {

// Cuts a simple polygon, convex or not, into its corner count - 2 triangles of the same winding by
// clipping ears (Meisters 1975, "Polygons have ears"), in the plane that fits the corners best.
// A polygon that crosses itself or has no area gets that many triangles as well, of whatever shape.
std::vector<uvec3> triangulate(std::span<const vec3> corners);  // into corners

}  // namespace antiradiance
