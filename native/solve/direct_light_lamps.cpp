// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"
#include "scene/lamp.h"
#include "scene/ray_scene.h"
#include "solve/direct_light_emitter.h"
#include "solve/direct_light_geometry.h"

namespace antiradiance {

namespace {

// Point and spot lamps: a sphere of radiance intensity / (pi r^2); the unit is 1 W/sr of intensity,
// which stays finite when the radius is 0.
class SphereEmitter final : public Emitter {
public:
    SphereEmitter(const Lamp& lamp, float epsilon)
        : lamp_(lamp),
          center_(lamp_position(lamp)),
          intensity_(lamp_intensity(lamp)),
          radius_(lamp.radius > epsilon ? lamp.radius : 0),
          least_distance_(epsilon) {
        if (lamp.type == LampType::kSpot) outer_angle_ = widest_half_angle(lamp);
    }

    float unshadowed(const SurfacePoint& receiver) const override {
        const vec3 to = center_ - receiver.position;
        const float d = std::max(glm::length(to), least_distance_);
        if (d <= radius_) return 1 / (radius_ * radius_);
        const float cosine = glm::dot(to, receiver.shading_normal) / d;
        const float sine = radius_ / d;
        if (cosine <= -sine || misses_cone(to / d, sine)) return 0;
        if (cosine >= sine) return cosine / (d * d);
        return sphere_irradiance(cosine, sine) / (radius_ * radius_);
    }

    LightSample sample(const SurfacePoint& receiver, const vec2& u) const override {
        const vec3 to = center_ - receiver.position;
        const float d = std::max(glm::length(to), least_distance_);
        LightSample s;
        if (radius_ == 0) {
            s.direction = to / d;
            s.distance = d;
            s.weight = std::max(0.0F, glm::dot(s.direction, receiver.shading_normal)) / (d * d);
        } else if (d <= radius_) {
            s.direction = Frame(receiver.shading_normal).to_world(cosine_hemisphere(u));
            const float along = glm::dot(to, s.direction);
            s.distance = along + std::sqrt(radius_ * radius_ - d * d + along * along);
            s.weight = 1 / (radius_ * radius_);
        } else {
            const float sine2 = radius_ * radius_ / (d * d);
            const float one_minus_cos = sine2 / (1 + std::sqrt(1 - sine2));
            s.direction = sample_cone(to / d, one_minus_cos, u);
            const float along = glm::dot(to, s.direction);
            const float inside = radius_ * radius_ - d * d + along * along;
            s.distance = along - std::sqrt(std::max(0.0F, inside));
            s.weight = 2 * one_minus_cos / (radius_ * radius_) *
                       std::max(0.0F, glm::dot(s.direction, receiver.shading_normal));
        }
        s.target = receiver.position + s.direction * s.distance;
        s.radiance = intensity_;
        if (lamp_.type == LampType::kSpot) s.radiance *= spot_falloff(lamp_, -s.direction);
        return s;
    }

    EmitterBounds bounds() const override {
        EmitterBounds b;
        b.center = center_;
        b.radius = radius_;
        b.power = luminance(intensity_);
        b.cosine = false;
        b.cos_spread = -1;
        if (lamp_.type == LampType::kSpot) {
            b.axis = lamp_direction(lamp_);
            b.cos_spread = std::cos(outer_angle_);
        } else {
            b.axis = vec3(0, 0, 1);
        }
        return b;
    }

private:
    static float widest_half_angle(const Lamp& lamp) {
        const float half = std::min(lamp.spot_angle / 2, kPi / 2);
        if (lamp.spot_cosine) return half;
        const float x = glm::length(vec3(lamp.to_world[0]));
        const float y = glm::length(vec3(lamp.to_world[1]));
        const float z = glm::length(vec3(lamp.to_world[2]));
        return half < kPi / 2 ? std::atan(std::tan(half) * std::max(x, y) / z) : half;
    }
    [[nodiscard]] bool misses_cone(const vec3& to_lamp, float sine) const {
        if (lamp_.type != LampType::kSpot) return false;
        const float angle =
            std::acos(std::clamp(-glm::dot(to_lamp, lamp_direction(lamp_)), -1.0F, 1.0F));
        return angle > outer_angle_ + std::asin(sine);
    }

    Lamp lamp_;
    vec3 center_;
    vec3 intensity_;
    float radius_;
    float least_distance_;
    float outer_angle_ = kPi;
};

// The unit is the irradiance on a facing surface.
class SunEmitter final : public Emitter {
public:
    explicit SunEmitter(const Lamp& lamp)
        : power_(lamp.power),
          to_sun_(-lamp_direction(lamp)),
          half_(std::clamp(lamp.sun_angle / 2, 0.0F, kPi / 2)),
          sine_(std::sin(half_)) {
        if (sine_ < 1e-4F) sine_ = 0;
    }

    float unshadowed(const SurfacePoint& receiver) const override {
        const float cosine = glm::dot(to_sun_, receiver.shading_normal);
        if (cosine >= sine_) return cosine;
        if (cosine <= -sine_) return 0;
        return sphere_irradiance(cosine, sine_) / (sine_ * sine_);
    }

    LightSample sample(const SurfacePoint& receiver, const vec2& u) const override {
        LightSample s;
        const float cos_half = std::sqrt(std::max(0.0F, 1 - sine_ * sine_));
        s.direction =
            sine_ == 0 ? to_sun_ : sample_cone(to_sun_, sine_ * sine_ / (1 + cos_half), u);
        s.distance = RayScene::kInfinity;
        s.weight =
            2 / (1 + cos_half) * std::max(0.0F, glm::dot(s.direction, receiver.shading_normal));
        s.radiance = power_;
        return s;
    }

    EmitterBounds bounds() const override { return {}; }
    bool at_infinity() const override { return true; }

private:
    vec3 power_;
    vec3 to_sun_;
    float half_;  // rad
    float sine_;
};

// Regular polygon of the unit circle's area, so that its irradiance agrees with the disk's to
// second order in size / distance.
template <std::size_t N>
const std::array<vec2, N>& equal_area_polygon() {
    static const std::array<vec2, N> corners = [] {
        std::array<vec2, N> c;
        const float step = 2 * kPi / static_cast<float>(N);
        const float radius = std::sqrt(2 * kPi / (static_cast<float>(N) * std::sin(step)));
        for (std::size_t i = 0; i < N; ++i) {
            const float angle = step * static_cast<float>(i);
            c[i] = radius * vec2(std::cos(angle), std::sin(angle));
        }
        return c;
    }();
    return corners;
}

// An elliptic area lamp with the full spread.
class EllipseEmitter final : public Emitter {
public:
    EllipseEmitter(const Lamp& lamp, float epsilon)
        : center_(lamp_position(lamp)),
          axes_(area_lamp_axes(lamp)),
          normal_(lamp_direction(lamp)),
          area_(axes_.area(AreaShape::kEllipse)),
          radiance_(area_lamp_radiance(lamp)),
          epsilon_(epsilon) {}

    float unshadowed(const SurfacePoint& receiver) const override {
        const vec3 to = center_ - receiver.position;
        if (glm::dot(to, normal_) >= -epsilon_) return 0;
        const float size2 = glm::dot(axes_.x, axes_.x) + glm::dot(axes_.y, axes_.y);
        // At twice the size, 12 corners are within 2e-4 of the ellipse.
        return glm::dot(to, to) > 4 * size2 ? irradiance<12>(to, receiver.shading_normal)
                                            : irradiance<56>(to, receiver.shading_normal);
    }

    LightSample sample(const SurfacePoint& receiver, const vec2& u) const override {
        const vec2 d = concentric_disk(u);
        LightSample s;
        s.target = center_ + axes_.x * d.x + axes_.y * d.y;
        const vec3 to = s.target - receiver.position;
        const float distance2 = glm::dot(to, to);
        s.distance = std::sqrt(distance2);
        s.direction = to / s.distance;
        s.weight = area_ * std::max(0.0F, glm::dot(s.direction, receiver.shading_normal)) *
                   std::max(0.0F, -glm::dot(s.direction, normal_)) / distance2;
        s.radiance = radiance_;
        return s;
    }

    EmitterBounds bounds() const override {
        EmitterBounds b;
        b.center = center_;
        b.radius = std::sqrt(glm::dot(axes_.x, axes_.x) + glm::dot(axes_.y, axes_.y));
        b.power = luminance(radiance_) * area_;
        b.axis = normal_;
        return b;
    }

private:
    template <std::size_t N>
    [[nodiscard]] float irradiance(const vec3& to_center, const vec3& normal) const {
        std::array<vec3, N> corners;
        for (std::size_t i = 0; i < N; ++i) {
            const vec2& p = equal_area_polygon<N>()[i];
            corners[i] = to_center + axes_.x * p.x + axes_.y * p.y;
        }
        return polygon_irradiance(corners, normal);
    }

    vec3 center_;
    AreaAxes axes_;
    vec3 normal_;
    float area_;
    vec3 radiance_;
    float epsilon_;
};

// An area lamp whose spread is below pi. Only the part of it that the slats leave visible from the
// receiver is sampled, without which a narrow beam would be all noise.
class SpreadEmitter final : public Emitter {
public:
    SpreadEmitter(const Lamp& lamp, float epsilon)
        : lamp_(lamp),
          center_(lamp_position(lamp)),
          axes_(area_lamp_axes(lamp)),
          normal_(lamp_direction(lamp)),
          radiance_(area_lamp_radiance(lamp)),
          tan_half_(std::tan(lamp.spread / 2)),
          epsilon_(epsilon) {
        const vec3 up = glm::cross(axes_.x, axes_.y);
        const float scale = glm::dot(up, up);
        dual_x_ = glm::cross(axes_.y, up) / scale;
        dual_y_ = glm::cross(up, axes_.x) / scale;
    }

    float unshadowed(const SurfacePoint& receiver) const override {
        VisiblePart part;
        return visible_part(receiver.position, part) ? polygon_of(part).unshadowed(receiver) : 0;
    }

    LightSample sample(const SurfacePoint& receiver, const vec2& u) const override {
        VisiblePart part;
        if (!visible_part(receiver.position, part)) return {};
        LightSample s = polygon_of(part).sample(receiver, u);
        s.radiance = radiance_ * area_lamp_spread(lamp_, -s.direction);
        const vec3 offset = s.target - center_;
        const vec2 local(glm::dot(offset, dual_x_), glm::dot(offset, dual_y_));
        if (lamp_.shape == AreaShape::kEllipse && glm::dot(local, local) > 1) s.radiance = vec3(0);
        return s;
    }

    EmitterBounds bounds() const override {
        EmitterBounds b;
        b.center = center_;
        b.radius = glm::length(axes_.x) + glm::length(axes_.y);
        b.power = luminance(radiance_) * area_lamp_spread(lamp_, normal_) * axes_.area(lamp_.shape);
        b.axis = normal_;
        b.cos_spread = std::cos(lamp_.spread / 2);
        b.cosine = false;
        return b;
    }

private:
    struct VisiblePart {
        vec2 low, high;  // -1..1 in the lamp's axes
    };

    bool visible_part(const vec3& p, VisiblePart& part) const {
        const vec3 from = p - center_;
        const float height = glm::dot(from, normal_);
        if (height <= epsilon_) return false;
        const vec2 foot(glm::dot(from, dual_x_), glm::dot(from, dual_y_));
        const float reach = height * tan_half_;
        const vec2 half(reach * glm::length(dual_x_), reach * glm::length(dual_y_));
        part.low = glm::max(foot - half, vec2(-1));
        part.high = glm::min(foot + half, vec2(1));
        return part.low.x < part.high.x && part.low.y < part.high.y;
    }

    [[nodiscard]] PolygonEmitter polygon_of(const VisiblePart& part) const {
        const auto at = [&](float x, float y) { return center_ + axes_.x * x + axes_.y * y; };
        std::array<vec3, 4> corners{at(part.low.x, part.low.y), at(part.low.x, part.high.y),
                                    at(part.high.x, part.high.y), at(part.high.x, part.low.y)};
        if (glm::dot(glm::cross(axes_.x, axes_.y), normal_) > 0) std::swap(corners[1], corners[3]);
        return {corners, 4, radiance_, false, epsilon_};
    }

    Lamp lamp_;
    vec3 center_;
    AreaAxes axes_;
    vec3 normal_;
    vec3 radiance_;
    vec3 dual_x_, dual_y_;  // 1/m: turn an offset in the lamp's plane into its axes' coordinates
    float tan_half_;
    float epsilon_;
};

}  // namespace

EmitterPtr make_lamp_emitter(const Lamp& lamp, float epsilon) {
    if (max_component(lamp.power) <= 0) return nullptr;
    switch (lamp.type) {
        case LampType::kPoint:
        case LampType::kSpot:
            return std::make_unique<SphereEmitter>(lamp, epsilon);
        case LampType::kSun:
            return std::make_unique<SunEmitter>(lamp);
        case LampType::kArea:
            break;
    }
    if (lamp.spread < kPi) return std::make_unique<SpreadEmitter>(lamp, epsilon);
    if (lamp.shape == AreaShape::kEllipse) return std::make_unique<EllipseEmitter>(lamp, epsilon);
    return std::make_unique<PolygonEmitter>(area_lamp_corners(lamp), 4, area_lamp_radiance(lamp),
                                            false, epsilon);
}

}  // namespace antiradiance
