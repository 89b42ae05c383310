// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/lamp.h"

#include <algorithm>
#include <cmath>

namespace antiradiance {

namespace {

// Directions in the lamp's own space. Blender 3.4 turns them only, newer ones also undo the scale,
// so that a scaled spot has an elliptic cone.
vec3 to_local_direction(const Lamp& lamp, const vec3& direction) {
    vec3 local;
    for (int i = 0; i < 3; ++i) {
        const vec3 axis(lamp.to_world[i]);
        const float length2 = glm::dot(axis, axis);
        if (length2 <= 0) return {0, 0, 0};
        local[i] = glm::dot(axis, direction) / (lamp.spot_cosine ? std::sqrt(length2) : length2);
    }
    const float length = glm::length(local);
    return length > 0 ? local / length : local;
}

float smoothstep(float t) {
    t = std::clamp(t, 0.0F, 1.0F);
    return t * t * (3 - 2 * t);
}

}  // namespace

vec3 lamp_intensity(const Lamp& lamp) {
    return lamp.power / (4 * kPi);
}

vec3 lamp_direction(const Lamp& lamp) {
    return -glm::normalize(vec3(lamp.to_world[2]));
}

float spot_falloff(const Lamp& lamp, const vec3& direction) {
    const float cosine = -to_local_direction(lamp, direction).z;
    const float edge = std::cos(lamp.spot_angle / 2);
    if (cosine <= edge) return 0;
    const float fade = (1 - edge) * lamp.spot_blend;
    const float inside = fade > 0 ? smoothstep((cosine - edge) / fade) : 1.0F;
    return lamp.spot_cosine ? inside * std::max(cosine, 0.0F) : inside;
}

AreaAxes area_lamp_axes(const Lamp& lamp) {
    return {vec3(lamp.to_world[0]) * (lamp.size.x / 2), vec3(lamp.to_world[1]) * (lamp.size.y / 2)};
}

float AreaAxes::area(AreaShape shape) const {
    const float rectangle = 4 * glm::length(glm::cross(x, y));
    return shape == AreaShape::kEllipse ? rectangle * kPi / 4 : rectangle;
}

std::array<vec3, 4> area_lamp_corners(const Lamp& lamp) {
    const AreaAxes axes = area_lamp_axes(lamp);
    const vec3 c = lamp_position(lamp);
    std::array<vec3, 4> corners{c - axes.x - axes.y, c - axes.x + axes.y, c + axes.x + axes.y,
                                c + axes.x - axes.y};
    // A mirrored lamp still shines along its local -z.
    if (glm::dot(glm::cross(axes.x, axes.y), vec3(lamp.to_world[2])) < 0) {
        std::swap(corners[1], corners[3]);
    }
    return corners;
}

vec3 area_lamp_radiance(const Lamp& lamp) {
    const float area = area_lamp_axes(lamp).area(lamp.shape);
    return area > 0 ? lamp.power / (4 * area) : vec3(0);
}

float area_lamp_spread(const Lamp& lamp, const vec3& direction) {
    if (lamp.spread >= kPi) return 1;
    const float cosine = glm::dot(direction, lamp_direction(lamp));
    if (cosine <= 0) return 0;
    const float half = lamp.spread / 2;
    const float slats = std::tan(half);
    const float tangent = std::sqrt(std::max(0.0F, 1 - cosine * cosine)) / cosine;
    // tan(a) - a loses its digits for small a: a^3/3 is the first term of its series.
    const float norm = half < 0.05F ? half * half * half / 3 : slats - half;
    return norm > 0 ? std::max(0.0F, slats - tangent) / norm : 0.0F;
}

}  // namespace antiradiance
