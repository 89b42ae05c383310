// SPDX-License-Identifier: GPL-3.0-or-later
// The clamped cosine to second order, so that a cluster's light is nine numbers a colour.
// Ramamoorthi & Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps":
// max(0, cos) ~ 1/4 + cos/2 + 15/32 (cos^2 - 1/3), exact coefficients of the first three bands.
#include "shared/transport_layout.glsl"

// Basis at a unit vector v; the cross terms appear twice in v v^T.
void direction_moments(vec3 v, out float basis[kMomentCount]) {
    basis[0] = v.x;
    basis[1] = v.y;
    basis[2] = v.z;
    basis[3] = v.x * v.x;
    basis[4] = v.y * v.y;
    basis[5] = v.z * v.z;
    basis[6] = v.x * v.y;
    basis[7] = v.x * v.z;
    basis[8] = v.y * v.z;
}

// sum_i weight_i ~max(0, v_i . d) from the moments sum_i weight_i direction_moments(v_i).
vec3 clamped_cosine_sum(vec4 moments[kMomentCount], vec3 d) {
    vec3 total = moments[3].rgb + moments[4].rgb + moments[5].rgb;
    vec3 linear = moments[0].rgb * d.x + moments[1].rgb * d.y + moments[2].rgb * d.z;
    vec3 quadratic = moments[3].rgb * (d.x * d.x) + moments[4].rgb * (d.y * d.y) +
                     moments[5].rgb * (d.z * d.z) +
                     2.0 * (moments[6].rgb * (d.x * d.y) + moments[7].rgb * (d.x * d.z) +
                            moments[8].rgb * (d.y * d.z));
    return total / 4.0 + linear / 2.0 + 15.0 / 32.0 * (quadratic - total / 3.0);
}
