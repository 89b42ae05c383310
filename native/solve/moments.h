// SPDX-License-Identifier: GPL-3.0-or-later
// Clusters in O(1) a link: the light that a cluster sends and receives as moments over directions,
// from the clamped cosine to second order (algorithm.md "Clusters"):
//     max(0, n.d) ~ 1/4 + n.d / 2 + 15/32 ((n.d)^2 - 1/3),
// off by at most .094, and by .0625 behind the surface.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "hierarchy/patch_tree.h"

namespace antiradiance {

// sum w, sum w v, sum w v v^T over unit vectors v with weights w, for red, green and blue.
struct Moments {
    std::array<vec3, 9> m{};  // x, y, z, xx, yy, zz, xy, xz, yz

    void add(const vec3& v, const vec3& weight) {
        const std::array<float, 9> basis = basis_of(v);
        for (std::size_t i = 0; i < 9; ++i)
            m[i] += basis[i] * weight;
    }
    Moments& operator+=(const Moments& other) {
        for (std::size_t i = 0; i < 9; ++i)
            m[i] += other.m[i];
        return *this;
    }
    // sum w max(0, v.d), approximately; never negative.
    [[nodiscard]] vec3 clamped_cosine(const vec3& d) const {
        const vec3 m0 = m[3] + m[4] + m[5];
        vec3 first(0);
        vec3 second(0);
        const std::array<float, 9> basis = basis_of(d);
        for (std::size_t i = 0; i < 3; ++i)
            first += basis[i] * m[i];
        for (std::size_t i = 3; i < 6; ++i)
            second += basis[i] * m[i];
        for (std::size_t i = 6; i < 9; ++i)
            second += 2 * basis[i] * m[i];
        return glm::max(vec3(0), m0 / 4.0F + first / 2.0F + 15.0F / 32.0F * (second - m0 / 3.0F));
    }
    // sum w v.d, for vectors that all lie within a narrow cone.
    [[nodiscard]] vec3 plain_cosine(const vec3& d) const {
        return glm::max(vec3(0), d.x * m[0] + d.y * m[1] + d.z * m[2]);
    }

private:
    static std::array<float, 9> basis_of(const vec3& v) {
        return {v.x, v.y, v.z, v.x * v.x, v.y * v.y, v.z * v.z, v.x * v.y, v.x * v.z, v.y * v.z};
    }
};

// What clusters send: the sum over their surfaces of area x radiance about the normal, so that
// clamped_cosine(d) is the radiant intensity towards d, W/sr. Lamps are left out: they link by
// themselves. radiance: #nodes, W/(m2 sr).                                // #nodes, 0 at patches
[[nodiscard]] std::vector<Moments> pull_moments(const PatchTree& tree,
                                                std::span<const vec3> radiance);

// Normals that differ less than this (cosine) count as a narrow cone.
inline constexpr float kNarrowCone = 0.9F;

}  // namespace antiradiance
