// SPDX-License-Identifier: GPL-3.0-or-later
// Deterministic sampling: every sample is a function of its indices, so results do not depend on
// the number of threads and an animation does not flicker.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/types.h"

namespace antiradiance {

// Avalanche hash, "lowbias32" (C. Wellons, "Prospecting for hash functions", 2018).
inline std::uint32_t hash_u32(std::uint32_t x) {
    x ^= x >> 16U;
    x *= 0x7feb352dU;
    x ^= x >> 15U;
    x *= 0x846ca68bU;
    x ^= x >> 16U;
    return x;
}

inline std::uint32_t hash_combine(std::uint32_t a, std::uint32_t b) {
    return hash_u32(a ^ (b + 0x9e3779b9U + (a << 6U) + (a >> 2U)));
}

// [0, 1)
inline float to_unit_float(std::uint32_t bits) {
    return static_cast<float>(bits >> 8U) * 0x1p-24F;
}

// Point `index` of the R2 low-discrepancy sequence (M. Roberts, "The Unreasonable Effectiveness of
// Quasirandom Sequences", 2018), shifted by a random offset that `seed` selects
// (Cranley-Patterson).
inline vec2 r2_sample(std::uint32_t index, std::uint32_t seed) {
    const std::uint32_t a = hash_u32(seed);
    const std::uint32_t b = hash_u32(a ^ 0x68bc21ebU);
    return {to_unit_float(a + index * 3242174889U), to_unit_float(b + index * 2447445414U)};
}

// Right-handed orthonormal basis whose z axis is n (Duff et al. 2017, "Building an Orthonormal
// Basis, Revisited").
struct Frame {
    explicit Frame(const vec3& normal) : n(normal) {
        const float sign = std::copysign(1.0F, n.z);
        const float a = -1.0F / (sign + n.z);
        const float b = n.x * n.y * a;
        t = vec3(1.0F + sign * n.x * n.x * a, sign * b, -sign * n.x);
        s = vec3(b, sign + n.y * n.y * a, -n.y);
    }
    [[nodiscard]] vec3 to_world(const vec3& local) const {
        return t * local.x + s * local.y + n * local.z;
    }
    vec3 t, s, n;
};

// Unit square -> unit disk, area preserving (Shirley & Chiu 1997).
inline vec2 concentric_disk(const vec2& u) {
    const vec2 p = 2.0F * u - 1.0F;
    if (p.x == 0 && p.y == 0) return {0, 0};
    const bool wide = std::abs(p.x) > std::abs(p.y);
    const float radius = wide ? p.x : p.y;
    const float angle = wide ? kPi / 4 * (p.y / p.x) : kPi / 2 - kPi / 4 * (p.x / p.y);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

// Direction about +z with density cos / pi (Malley's method).
inline vec3 cosine_hemisphere(const vec2& u) {
    const vec2 d = concentric_disk(u);
    return {d.x, d.y, std::sqrt(std::max(0.0F, 1.0F - d.x * d.x - d.y * d.y))};
}

}  // namespace antiradiance
