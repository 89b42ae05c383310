// SPDX-License-Identifier: GPL-3.0-or-later
// Closed forms of the irradiance from polygons and spheres of unit radiance, and the sampling of
// their directions.
#pragma once

#include <span>

#include "base/types.h"

namespace antiradiance {

// Irradiance at the origin of a plane with unit `normal` from a polygon of radiance 1 (its corners
// relative to the origin), clipped at the plane's horizon; unoccluded. Lambert's formula (Lambert
// 1760; Baum et al. 1989, Eq. 4). At most 60 corners.
[[nodiscard]] float polygon_irradiance(std::span<const vec3> corners, const vec3& normal);

// Irradiance, relative to pi, from a sphere or disk of directions of radiance 1 whose centre stands
// at cosine `cos_theta` to the normal and whose half angle has the sine `sin_sigma`; the part below
// the horizon is cut off (Snyder, "Area Light Sources for Real-Time Graphics", 1996).
[[nodiscard]] float sphere_irradiance(float cos_theta, float sin_sigma);

// cos cos / d^2 from a point of a surface with unit `normal` to a receiver, 1/m2; 0 behind either.
[[nodiscard]] float point_to_point(const vec3& receiver, const vec3& receiver_normal,
                                   const vec3& point, const vec3& normal);

// Unit direction in the cone of half angle sigma about `axis`, uniform by solid angle.
// one_minus_cos: 1 - cos(sigma), exact for small angles.
[[nodiscard]] vec3 sample_cone(const vec3& axis, float one_minus_cos, const vec2& u);

// The triangle of directions with unit corners a, b, c.
class SphericalTriangle {
public:
    SphericalTriangle(const vec3& a, const vec3& b, const vec3& c);
    [[nodiscard]] float solid_angle() const { return solid_angle_; }
    // Uniform by solid angle (Arvo, "Stratified Sampling of Spherical Triangles", 1995).
    [[nodiscard]] vec3 sample(const vec2& u) const;

private:
    vec3 a_, b_, c_;
    float solid_angle_ = 0;  // sr
    float alpha_ = 0;        // rad, inner angle at a
};

}  // namespace antiradiance
