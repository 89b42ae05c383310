// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "links/form_factor.h"
#include "solve/direct_light_emitter.h"
#include "solve/direct_light_geometry.h"

namespace antiradiance {

namespace {

// Below this solid angle (sr), points spread by area differ little in weight, which the estimate's
// ratio makes up for, at a third of the cost; and the sampling of spherical triangles starts to
// lose its digits at .05.
constexpr float kSmallSolidAngle = 0.3F;

}  // namespace

PolygonEmitter::PolygonEmitter(const std::array<vec3, 4>& corners, std::size_t count,
                               const vec3& radiance, bool two_sided, float epsilon)
    : corners_(corners),
      count_(count),
      radiance_(radiance),
      epsilon_(epsilon),
      two_sided_(two_sided) {
    const vec3 first = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const vec3 second =
        count == 4 ? glm::cross(corners[2] - corners[0], corners[3] - corners[0]) : vec3(0);
    const float area1 = glm::length(first) / 2;
    const float area2 = glm::length(second) / 2;
    area_ = area1 + area2;
    const vec3 sum = first + second;
    const float length = glm::length(sum);
    normal_ = length > 0 ? sum / length : vec3(0, 0, 1);
    first_share_ = area_ > 0 ? area1 / area_ : 1.0F;
    center_ = vec3(0);
    for (std::size_t i = 0; i < count; ++i)
        center_ += corners[i] / static_cast<float>(count);
}

float PolygonEmitter::unshadowed(const SurfacePoint& receiver) const {
    const float height = glm::dot(receiver.position - corners_[0], normal_);
    if (two_sided_ ? std::abs(height) <= epsilon_ : height <= epsilon_) return 0;
    std::array<vec3, 4> relative;
    for (std::size_t i = 0; i < count_; ++i)
        relative[i] = corners_[i] - receiver.position;
    return kPi *
           std::abs(point_form_factor(vec3(0), receiver.shading_normal, {relative.data(), count_}));
}

vec3 PolygonEmitter::point_of_area(const vec2& u) const {
    const bool first = u.x < first_share_;
    const float x = first ? u.x / first_share_ : (u.x - first_share_) / (1 - first_share_);
    const vec3& b = first ? corners_[1] : corners_[2];
    const vec3& c = first ? corners_[2] : corners_[3];
    const float root = std::sqrt(x);
    return corners_[0] * (1 - root) + b * (root * (1 - u.y)) + c * (root * u.y);
}

LightSample PolygonEmitter::sample_area(const SurfacePoint& receiver, const vec2& u) const {
    LightSample s;
    s.target = point_of_area(u);
    const vec3 to = s.target - receiver.position;
    const float distance2 = glm::dot(to, to);
    s.distance = std::sqrt(distance2);
    s.direction = to / s.distance;
    s.weight = area_ * std::max(0.0F, glm::dot(s.direction, receiver.shading_normal)) *
               std::abs(glm::dot(s.direction, normal_)) / distance2;
    return s;
}

LightSample PolygonEmitter::sample(const SurfacePoint& receiver, const vec2& u) const {
    const vec3 to_center = center_ - receiver.position;
    const float distance2 = glm::dot(to_center, to_center);
    LightSample s;
    if (area_ < kSmallSolidAngle * distance2) {
        s = sample_area(receiver, u);
    } else {
        const auto direction_to = [&](std::size_t i) {
            return glm::normalize(corners_[i] - receiver.position);
        };
        const vec3 a = direction_to(0);
        const vec3 c = direction_to(2);
        const SphericalTriangle first(a, direction_to(1), c);
        const float omega1 = first.solid_angle();
        float omega = omega1;
        vec2 v = u;
        if (count_ == 4) {
            const SphericalTriangle second(a, c, direction_to(3));
            omega += second.solid_angle();
            const float share = omega > 0 ? omega1 / omega : 1.0F;
            if (u.x < share) {
                s.direction = first.sample({u.x / share, u.y});
            } else {
                s.direction = second.sample({(u.x - share) / (1 - share), u.y});
            }
        } else {
            s.direction = first.sample(v);
        }
        const float slope = glm::dot(s.direction, normal_);
        const float distance = glm::dot(corners_[0] - receiver.position, normal_) / slope;
        // Numbers run out where the receiver nearly touches the polygon's plane.
        if (!(distance > 0) || distance * distance > 1e6F * (distance2 + area_)) {
            s = sample_area(receiver, u);
        } else {
            s.distance = distance;
            s.target = receiver.position + s.direction * distance;
            s.weight = omega * std::max(0.0F, glm::dot(s.direction, receiver.shading_normal));
        }
    }
    // Off the emitting surface, towards the receiver.
    s.target += normal_ * (glm::dot(s.direction, normal_) < 0 ? epsilon_ : -epsilon_);
    s.radiance = radiance_;
    return s;
}

float PolygonEmitter::density(const SurfacePoint& receiver, const vec3& direction) const {
    const vec3 to_center = center_ - receiver.position;
    const float slope = glm::dot(direction, normal_);
    if (area_ < kSmallSolidAngle * glm::dot(to_center, to_center)) {
        const float distance = glm::dot(to_center, normal_) / slope;
        return distance * distance / (area_ * std::abs(slope));
    }
    const auto direction_to = [&](std::size_t i) {
        return glm::normalize(corners_[i] - receiver.position);
    };
    float omega = 0;
    for (std::size_t i = 2; i < count_; ++i) {
        omega +=
            SphericalTriangle(direction_to(0), direction_to(i - 1), direction_to(i)).solid_angle();
    }
    return omega > 0 ? 1 / omega : 0.0F;
}

Box PolygonEmitter::box() const {
    Box box;
    for (std::size_t i = 0; i < count_; ++i)
        box.add(corners_[i]);
    return box;
}

EmitterBounds PolygonEmitter::bounds() const {
    EmitterBounds b;
    b.center = center_;
    for (std::size_t i = 0; i < count_; ++i) {
        b.radius = std::max(b.radius, glm::distance(corners_[i], center_));
    }
    b.power = luminance(radiance_) * area_;
    b.axis = normal_;
    b.two_sided = two_sided_;
    return b;
}

// Of one that shines from both sides, every second point is of its back.
EmitterPoint PolygonEmitter::point(std::uint32_t index) const {
    const bool back = two_sided_ && index % 2 == 1;
    const vec3 axis = back ? -normal_ : normal_;
    const vec2 u = r2_sample(two_sided_ ? index / 2 : index, kPointSeed);
    // A map without a fold keeps the even spread of few points.
    const vec3 diagonal = corners_[1] - corners_[0] + corners_[3] - corners_[0];
    const bool is_parallelogram =
        count_ == 4 && glm::distance(corners_[0] + diagonal, corners_[2]) <= epsilon_;
    const vec3 at = is_parallelogram ? corners_[0] + u.x * (corners_[1] - corners_[0]) +
                                           u.y * (corners_[3] - corners_[0])
                                     : point_of_area(u);
    return {at + axis * epsilon_, axis, kPi / 2};
}

float PolygonEmitter::weight(const SurfacePoint& receiver, const EmitterPoint& point) const {
    return point_to_point(receiver.position, receiver.shading_normal, point.position, point.axis);
}

}  // namespace antiradiance
