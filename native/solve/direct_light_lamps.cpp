// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
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

    EmitterPoint point(std::uint32_t index) const override {
        EmitterPoint p;
        p.position = center_ + radius_ * point_of_ball(index);
        if (lamp_.type == LampType::kSpot) {
            p.axis = lamp_direction(lamp_);
            p.reach = outer_angle_;
        }
        return p;
    }

    float weight(const SurfacePoint& receiver, const EmitterPoint& point) const override {
        const vec3 to = point.position - receiver.position;
        const float d = std::max(glm::length(to), least_distance_);
        const float spot = is_coloured() ? spot_falloff(lamp_, -to / d) : 1.0F;
        return spot * std::max(0.0F, glm::dot(to, receiver.shading_normal)) / (d * d * d);
    }

    bool is_point() const override { return radius_ == 0; }
    float most_unshadowed() const override { return RayScene::kInfinity; }

protected:
    bool is_coloured() const override { return lamp_.type == LampType::kSpot; }

private:
    // A point of the unit ball. Many of them look like an evenly bright disk from every side: they
    // are points of the sphere in four dimensions, without their last coordinate.
    static vec3 point_of_ball(std::uint32_t index) {
        constexpr std::uint32_t kThird = 1779033703;  // sqrt(2), beside R2's two irrational steps
        const vec2 u = r2_sample(index, kPointSeed);
        const float first = std::sqrt(1 - u.x);
        const float second = std::sqrt(u.x);
        return {first * std::cos(2 * kPi * u.y), first * std::sin(2 * kPi * u.y),
                second * std::cos(2 * kPi * to_unit_float(index * kThird))};
    }
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

    EmitterBounds bounds() const override {
        EmitterBounds b;
        b.axis = -to_sun_;
        b.cos_spread = std::cos(half_);
        return b;
    }
    bool at_infinity() const override { return true; }

    EmitterPoint point(std::uint32_t index) const override {
        EmitterPoint p;
        const float cos_half = std::sqrt(std::max(0.0F, 1 - sine_ * sine_));
        p.axis =
            -sample_cone(to_sun_, sine_ * sine_ / (1 + cos_half), r2_sample(index, kPointSeed));
        p.reach = 0;
        return p;
    }
    float weight(const SurfacePoint& receiver, const EmitterPoint& point) const override {
        return std::max(0.0F, -glm::dot(point.axis, receiver.shading_normal));
    }
    bool is_point() const override { return sine_ == 0; }

private:
    vec3 power_;
    vec3 to_sun_;
    float half_;  // rad
    float sine_;
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
    if (lamp.spread < kPi) return make_spread_emitter(lamp, epsilon);
    if (lamp.shape == AreaShape::kEllipse) return make_ellipse_emitter(lamp, epsilon);
    return std::make_unique<PolygonEmitter>(area_lamp_corners(lamp), 4, area_lamp_radiance(lamp),
                                            false, epsilon);
}

}  // namespace antiradiance
