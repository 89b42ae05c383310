// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/visible_lamps.h"

#include <cmath>

#include "scene/lamp.h"
#include "scene/ray_scene.h"

namespace antiradiance {

namespace {

struct Seen {
    float distance = RayScene::kInfinity;  // m
    vec3 radiance{0};                      // W/(m2 sr)
};

Seen see_sphere(const Lamp& lamp, const CameraRay& ray) {
    const vec3 to = lamp_position(lamp) - ray.origin;
    const float along = glm::dot(to, ray.direction);
    const vec3 off = to - ray.direction * along;
    const float inside = lamp.radius * lamp.radius - glm::dot(off, off);
    if (inside <= 0) return {};
    const float half = std::sqrt(inside);
    const float distance = along - half > ray.near ? along - half : along + half;
    if (distance <= ray.near) return {};
    vec3 radiance = lamp_intensity(lamp) / (kPi * lamp.radius * lamp.radius);
    if (lamp.type == LampType::kSpot) radiance *= spot_falloff(lamp, -ray.direction);
    return {distance, radiance};
}

Seen see_area(const Lamp& lamp, const CameraRay& ray) {
    const float facing = -glm::dot(ray.direction, lamp_direction(lamp));
    if (facing <= 0) return {};
    const vec3 center = lamp_position(lamp);
    const float distance = glm::dot(center - ray.origin, lamp_direction(lamp)) / -facing;
    if (distance <= ray.near) return {};
    const vec3 at = ray.origin + ray.direction * distance - center;
    const AreaAxes axes = area_lamp_axes(lamp);
    const vec2 place(glm::dot(at, axes.x) / glm::dot(axes.x, axes.x),
                     glm::dot(at, axes.y) / glm::dot(axes.y, axes.y));
    const bool hit = lamp.shape == AreaShape::kEllipse
                         ? glm::dot(place, place) <= 1
                         : glm::max(glm::abs(place.x), glm::abs(place.y)) <= 1;
    if (!hit) return {};
    return {distance, area_lamp_radiance(lamp) * area_lamp_spread(lamp, -ray.direction)};
}

Seen see_sun(const Lamp& lamp, const CameraRay& ray) {
    const float sine = std::sin(std::min(lamp.sun_angle / 2, kPi / 2));
    const float cosine = std::sqrt(1 - sine * sine);
    if (sine <= 0 || -glm::dot(ray.direction, lamp_direction(lamp)) < cosine) return {};
    return {RayScene::kInfinity, lamp.power / (kPi * sine * sine)};
}

Seen see(const Lamp& lamp, const CameraRay& ray) {
    switch (lamp.type) {
        case LampType::kPoint:
        case LampType::kSpot:
            return see_sphere(lamp, ray);
        case LampType::kArea:
            return see_area(lamp, ray);
        case LampType::kSun:
            return see_sun(lamp, ray);
    }
    return {};
}

}  // namespace

VisibleLamps::VisibleLamps(std::span<const Lamp> lamps) {
    for (const Lamp& lamp : lamps) {
        if (lamp.visible_to_camera) lamps_.push_back(lamp);
    }
}

vec3 VisibleLamps::radiance(const CameraRay& ray, float far) const {
    Seen nearest{.distance = far};
    for (const Lamp& lamp : lamps_) {
        const Seen seen = see(lamp, ray);
        // <=: a sun at infinity shows against the sky.
        if (seen.distance <= nearest.distance && max_component(seen.radiance) > 0) nearest = seen;
    }
    return nearest.radiance;
}

}  // namespace antiradiance
