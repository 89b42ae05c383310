// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>

#include "base/random.h"
#include "scene/lamp.h"
#include "solve/direct_light_emitter.h"
#include "solve/direct_light_geometry.h"

namespace antiradiance {

namespace {

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

    EmitterPoint point(std::uint32_t index) const override {
        const vec2 d = concentric_disk(r2_sample(index, kPointSeed));
        return {center_ + axes_.x * d.x + axes_.y * d.y, normal_, kPi / 2};
    }

    float weight(const SurfacePoint& receiver, const EmitterPoint& point) const override {
        return point_to_point(receiver.position, receiver.shading_normal, point.position, normal_);
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

    EmitterPoint point(std::uint32_t index) const override {
        const vec2 u = r2_sample(index, kPointSeed);
        const vec2 at = lamp_.shape == AreaShape::kEllipse ? concentric_disk(u) : 2.0F * u - 1.0F;
        return {center_ + axes_.x * at.x + axes_.y * at.y, normal_, kPi / 2};
    }

    float weight(const SurfacePoint& receiver, const EmitterPoint& point) const override {
        const vec3 from = receiver.position - point.position;
        return area_lamp_spread(lamp_, glm::normalize(from)) *
               point_to_point(receiver.position, receiver.shading_normal, point.position, normal_);
    }

protected:
    bool is_coloured() const override { return true; }

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

EmitterPtr make_spread_emitter(const Lamp& lamp, float epsilon) {
    return std::make_unique<SpreadEmitter>(lamp, epsilon);
}

EmitterPtr make_ellipse_emitter(const Lamp& lamp, float epsilon) {
    return std::make_unique<EllipseEmitter>(lamp, epsilon);
}

}  // namespace antiradiance
