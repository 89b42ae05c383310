// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "base/types.h"

namespace antiradiance {

// Form factor from a polygon to a differential area at `point` with unit `normal`, clipped at its
// horizon: the cosine-weighted solid angle of the polygon over pi (Lambert 1760; in the form of
// Baum, Rushmeier & Winget 1989). Positive where the polygon's front (counter-clockwise) faces the
// point, negative where its back does. `corners`: 3 or 4, planar and convex, m.
float point_form_factor(const vec3& point, const vec3& normal, std::span<const vec3> corners);

// The same for a polygon that is small against its distance: A cos cos / (pi d^2), with the same
// sign; 0 below the horizon.
float far_form_factor(const vec3& point, const vec3& normal, const vec3& source_center,
                      const vec3& source_normal, float source_area);

}  // namespace antiradiance
