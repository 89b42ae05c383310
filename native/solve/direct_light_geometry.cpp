// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/direct_light_geometry.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/random.h"

namespace antiradiance {

namespace {

constexpr std::size_t kMostCorners = 64;

// Part of a polygon above the plane through the origin; one corner more at most.
std::size_t clip_to_horizon(std::span<const vec3> corners, const vec3& normal,
                            std::array<vec3, kMostCorners>& clipped) {
    std::size_t count = 0;
    vec3 previous = corners.back();
    float previous_height = glm::dot(previous, normal);
    for (const vec3& corner : corners) {
        const float height = glm::dot(corner, normal);
        if ((height > 0) != (previous_height > 0)) {
            const float t = previous_height / (previous_height - height);
            clipped[count++] = previous + (corner - previous) * t;
        }
        if (height > 0) clipped[count++] = corner;
        previous = corner;
        previous_height = height;
    }
    return count;
}

}  // namespace

float polygon_irradiance(std::span<const vec3> corners, const vec3& normal) {
    assert(corners.size() + 4 <= kMostCorners);
    std::array<vec3, kMostCorners> above;
    const std::size_t count = clip_to_horizon(corners, normal, above);
    if (count < 3) return 0;
    float sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const vec3& a = above[i];
        const vec3& b = above[i + 1 == count ? 0 : i + 1];
        const vec3 side = glm::cross(a, b);
        const float sine = glm::length(side);
        // The origin lies on this edge's line: its term is 0 or undefined, and a point apart it is
        // 0.
        if (sine <= 1e-30F) continue;
        sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(side, normal) / sine;
    }
    return std::abs(sum) / 2;
}

float sphere_irradiance(float cos_theta, float sin_sigma) {
    const float sin2_sigma = sin_sigma * sin_sigma;
    const float sin2_theta = std::max(0.0F, 1 - cos_theta * cos_theta);
    // Wholly above or below the horizon: |cos theta| >= sin sigma.
    if (cos_theta * cos_theta >= sin2_sigma) return std::max(0.0F, cos_theta * sin2_sigma);
    const float sin_theta = std::sqrt(sin2_theta);
    const float x = std::sqrt(std::max(0.0F, 1 / sin2_sigma - 1));
    const float y = std::clamp(-x * cos_theta / sin_theta, -1.0F, 1.0F);
    const float root = sin_theta * std::sqrt(std::max(0.0F, 1 - y * y));
    const float e = (cos_theta * std::acos(y) - x * root) * sin2_sigma +
                    (x > 0 ? std::atan(root / x) : kPi / 2);
    return std::max(0.0F, e) * kInvPi;
}

float point_to_point(const vec3& receiver, const vec3& receiver_normal, const vec3& point,
                     const vec3& normal) {
    const vec3 to = point - receiver;
    const float distance2 = glm::dot(to, to);
    const float cosines =
        std::max(0.0F, glm::dot(to, receiver_normal)) * std::max(0.0F, -glm::dot(to, normal));
    return distance2 > 0 ? cosines / (distance2 * distance2) : 0.0F;
}

vec3 sample_cone(const vec3& axis, float one_minus_cos, const vec2& u) {
    // A disk maps to a cap by area when 1 - cos grows with the square of the radius.
    const vec2 disk = concentric_disk(u);
    const float radius2 = glm::dot(disk, disk);
    const float drop = one_minus_cos * radius2;  // 1 - cos of this direction
    const float scale = std::sqrt(std::max(0.0F, one_minus_cos * (2 - drop)));
    return glm::normalize(Frame(axis).to_world(vec3(disk * scale, 1 - drop)));
}

SphericalTriangle::SphericalTriangle(const vec3& a, const vec3& b, const vec3& c)
    : a_(a), b_(b), c_(c) {
    const float volume = std::abs(glm::dot(a, glm::cross(b, c)));
    const float denominator = 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a);
    // Van Oosterom and Strackee 1983.
    solid_angle_ = 2 * std::atan2(volume, denominator);
    const vec3 ab = glm::cross(a, b);
    const vec3 ac = glm::cross(a, c);
    alpha_ = std::atan2(glm::length(glm::cross(ab, ac)), glm::dot(ab, ac));
}

vec3 SphericalTriangle::sample(const vec2& u) const {
    const float area = u.x * solid_angle_;
    const float s = std::sin(area - alpha_);
    const float t = std::cos(area - alpha_);
    const float cos_alpha = std::cos(alpha_);
    const float sin_alpha = std::sin(alpha_);
    const float cos_c = glm::dot(a_, b_);
    const float p = t - cos_alpha;
    const float v = s + sin_alpha * cos_c;
    const float denominator = (v * s + p * t) * sin_alpha;
    float q = denominator != 0 ? ((v * t - p * s) * cos_alpha - v) / denominator : 1.0F;
    q = std::clamp(q, -1.0F, 1.0F);
    const auto perpendicular = [](const vec3& w, const vec3& axis) {
        const vec3 r = w - axis * glm::dot(w, axis);
        const float length = glm::length(r);
        return length > 0 ? r / length : r;
    };
    const vec3 c_moved = q * a_ + std::sqrt(std::max(0.0F, 1 - q * q)) * perpendicular(c_, a_);
    const float z = 1 - u.y * (1 - glm::dot(c_moved, b_));
    return glm::normalize(z * b_ +
                          std::sqrt(std::max(0.0F, 1 - z * z)) * perpendicular(c_moved, b_));
}

}  // namespace antiradiance
