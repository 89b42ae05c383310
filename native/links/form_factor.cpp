// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/form_factor.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace antiradiance {

float point_form_factor(const vec3& point, const vec3& normal, std::span<const vec3> corners) {
    // Clip at the horizon (Sutherland & Hodgman 1974); a plane adds one corner to a convex polygon,
    // but the heights of a needle's corners may alternate in sign by rounding: 4 edges that cross,
    // between them 2 corners above.
    std::array<vec3, 6> v;
    std::size_t count = 0;
    vec3 from = corners.back() - point;
    float from_height = glm::dot(from, normal);
    for (const vec3& corner : corners) {
        const vec3 to = corner - point;
        const float to_height = glm::dot(to, normal);
        if ((from_height > 0) != (to_height > 0))
            v[count++] = from + (to - from) * (from_height / (from_height - to_height));
        if (to_height > 0) v[count++] = to;
        from = to;
        from_height = to_height;
    }
    if (count < 3) return 0;

    // atan2 keeps its accuracy for the narrow angles of far polygons, where acos has none left.
    vec3 sum(0);
    for (std::size_t i = 0; i < count; ++i) {
        const vec3& a = v[i];
        const vec3& b = v[(i + 1) % count];
        const vec3 c = glm::cross(a, b);
        const float sine = glm::length(c);
        if (sine > 0) sum += c * (std::atan2(sine, glm::dot(a, b)) / sine);
    }
    // Corners that run counter-clockwise as seen from their front run clockwise about the point.
    return -glm::dot(sum, normal) / (2 * kPi);
}

float far_form_factor(const vec3& point, const vec3& normal, const vec3& source_center,
                      const vec3& source_normal, float source_area) {
    const vec3 d = source_center - point;
    const float d2 = glm::dot(d, d);
    const float cos_receiver = std::max(0.0F, glm::dot(normal, d));
    return -source_area * cos_receiver * glm::dot(source_normal, d) / (kPi * d2 * d2);
}

}  // namespace antiradiance
