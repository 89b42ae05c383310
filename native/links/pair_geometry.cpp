// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/pair_geometry.h"

#include <algorithm>
#include <cmath>

#include "links/form_factor.h"

namespace antiradiance {

namespace {

// Distances in units of the larger radius beyond which a simpler form factor is below 1 % off
// (tests/native/links/test_form_factor.cpp).
constexpr float kFarDistance = 8;
constexpr float kOnePointDistance = 4;
constexpr float kFourPointsDistance = 1.6F;
constexpr float kCoplanarTolerance = 1e-4F;  // of the patches' size

// How much less or more the transfer A cos cos / (pi d^2) to a patch is on average over its area
// than at its centre, relative and to second order: half the trace of the Hessian times the
// covariance of the area. The centre of a patch always sees a facing one best; over the rows of a
// room, links without this add up to .3 % too much. d: m, from the other end to the patch or back.
float spread(const GrowingNode& patch, const GrowingNode& other, const vec3& d, float d2) {
    const float height = glm::dot(other.normal, d);
    if (std::abs(height) < patch.radius) return 0;  // cut by the other's plane: no smooth function
    const auto second_derivative = [&](const vec3& e) {
        const float along = glm::dot(d, e) / d2;
        return 24 * along * along - 8 * along * glm::dot(other.normal, e) / height -
               4 * glm::dot(e, e) / d2;
    };
    const auto& c = patch.corners;
    if (patch.corner_count == 4) {
        const vec3 u = 0.5F * (c[1] - c[0] + c[2] - c[3]);
        const vec3 v = 0.5F * (c[3] - c[0] + c[2] - c[1]);
        return (second_derivative(u) + second_derivative(v)) / 24;
    }
    return (second_derivative(c[1] - c[0]) + second_derivative(c[2] - c[1]) +
            second_derivative(c[0] - c[2])) /
           72;
}

// Place i of `count` (even) along a side: two Gauss-Legendre points in each half or quarter of it.
float gauss_place(int i, int count) {
    constexpr float kOffset = 0.28867513F;  // 1 / (2 sqrt 3)
    const float middle = static_cast<float>(i / 2) + 0.5F;
    return (middle + (i % 2 ? kOffset : -kOffset)) / (0.5F * static_cast<float>(count));
}

}  // namespace

PlaneSide side_of_plane(const GrowingNode& patch, const GrowingNode& plane) {
    const float height = glm::dot(patch.center - plane.center, plane.normal);
    if (height > patch.radius) return PlaneSide::kInFront;
    if (height < -patch.radius) return PlaneSide::kBehind;
    float low = height;
    float high = height;
    for (int i = 0; i < patch.corner_count; ++i) {
        const float h =
            glm::dot(patch.corners[static_cast<std::size_t>(i)] - plane.center, plane.normal);
        low = std::min(low, h);
        high = std::max(high, h);
    }
    const float tolerance = kCoplanarTolerance * (patch.radius + plane.radius);
    if (high <= tolerance) return PlaneSide::kBehind;
    return low >= -tolerance ? PlaneSide::kInFront : PlaneSide::kStraddles;
}

bool may_receive(const GrowingNode& receiver, const GrowingNode& source) {
    const vec3 d = source.center - receiver.center;
    if (!receiver.is_cluster()) return glm::dot(d, receiver.normal) + source.radius > 0;
    const float distance = glm::length(d);
    const float reach = source.radius + receiver.radius;
    if (distance <= reach || receiver.cone_cosine <= 0) return true;
    // The least angle between a normal of the cone and a direction to the source must be below 90
    // degrees: angle(n, d) - cone - asin(reach / distance) < pi / 2.
    const float angle = std::acos(std::clamp(glm::dot(receiver.normal, d) / distance, -1.0F, 1.0F));
    const float cone = std::acos(std::min(1.0F, receiver.cone_cosine));
    return angle - cone - std::asin(reach / distance) < kPi / 2;
}

vec3 point_of(const GrowingNode& n, const vec2& u) {
    if (n.corner_count == 4)
        return glm::mix(glm::mix(n.corners[0], n.corners[1], u.x),
                        glm::mix(n.corners[3], n.corners[2], u.x), u.y);
    vec2 t = u;  // square to triangle (Heitz 2019)
    if (t.y > t.x) {
        t.x *= 0.5F;
        t.y -= t.x;
    } else {
        t.y *= 0.5F;
        t.x -= t.y;
    }
    return n.corners[0] * (1 - t.x - t.y) + n.corners[1] * t.x + n.corners[2] * t.y;
}

float patch_form_factor(const GrowingNode& s, const GrowingNode& r, bool behind_source) {
    const vec3 d = s.center - r.center;
    const float d2 = glm::dot(d, d);
    const float larger = std::max(s.radius, r.radius);
    // Across the source's plane no single point of the receiver stands for all of it.
    const bool straddles = std::abs(glm::dot(d, s.normal)) < r.radius;
    if (!straddles && d2 > kFarDistance * kFarDistance * larger * larger)
        return std::abs(far_form_factor(r.center, r.normal, s.center, s.normal, s.area)) *
               (1 + spread(r, s, d, d2) + spread(s, r, d, d2));

    const std::span<const vec3> polygon(s.corners.data(), static_cast<std::size_t>(s.corner_count));
    const float sign = behind_source ? -1.0F : 1.0F;
    int grid = 4;
    if (!straddles && d2 > kOnePointDistance * kOnePointDistance * r.radius * r.radius) {
        grid = 1;
    } else if (d2 > kFourPointsDistance * kFourPointsDistance * larger * larger) {
        grid = 2;
    }
    if (grid == 1) {
        return std::max(0.0F, sign * point_form_factor(r.center, r.normal, polygon)) *
               (1 + spread(r, s, d, d2));
    }
    float sum = 0;
    for (int j = 0; j < grid; ++j) {
        for (int i = 0; i < grid; ++i) {
            const vec2 u(gauss_place(i, grid), gauss_place(j, grid));
            sum += std::max(0.0F, sign * point_form_factor(point_of(r, u), r.normal, polygon));
        }
    }
    return sum / static_cast<float>(grid * grid);
}

}  // namespace antiradiance
