// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/form_factor.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace antiradiance {

namespace {

constexpr std::size_t kLanes = 4;  // edges at once
// A plane adds one corner to a convex quad; the heights of a needle's corners may alternate in sign
// by rounding and leave 6. As many more as fill two groups of edges.
constexpr std::size_t kPadded = 2 * kLanes + 1;
constexpr float kTiny = 1e-30F;  // in place of a division by 0

// Corners relative to a point, one array a coordinate.
struct Corners {
    std::array<float, kPadded> x, y, z;
    std::size_t count = 0;

    void add(const vec3& v) {
        x[count] = v.x;
        y[count] = v.y;
        z[count] = v.z;
        ++count;
    }
    // Closes the polygon; the edges that are left over have no length and count nothing.
    void close() {
        for (std::size_t i = count; i < kPadded; ++i) {
            x[i] = x[0];
            y[i] = y[0];
            z[i] = z[0];
        }
    }
};

// The part of a polygon above the horizon (Sutherland & Hodgman 1974).
Corners clip(const vec3& point, const vec3& normal, std::span<const vec3> corners) {
    Corners above;
    std::array<float, 4> heights{};
    bool all = true;
    bool any = false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        heights[i] = glm::dot(corners[i] - point, normal);
        all = all && heights[i] > 0;
        any = any || heights[i] > 0;
    }
    if (!any) return above;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const vec3 to = corners[i] - point;
        if (!all) {
            const std::size_t before = i > 0 ? i - 1 : corners.size() - 1;
            const vec3 from = corners[before] - point;
            if ((heights[before] > 0) != (heights[i] > 0))
                above.add(from + (to - from) * (heights[before] / (heights[before] - heights[i])));
        }
        if (heights[i] > 0) above.add(to);
    }
    return above;
}

// atan(t) / t for t in [0, 1] from t2 = t^2, 2e-8 off at most (Abramowitz & Stegun 1964, 4.4.49).
float arctangent_share(float t2) {
    const float high = ((0.0028662257F * t2 - 0.0161657367F) * t2 + 0.0429096138F) * t2;
    const float middle = ((high - 0.0752896400F) * t2 + 0.1065626393F) * t2;
    return ((((middle - 0.1420889944F) * t2 + 0.1999355085F) * t2) - 0.3333314528F) * t2 + 1;
}

// Sum over four edges of the angle they span times the component along `normal` of the unit vector
// across them. The arctangent keeps its accuracy for the narrow angles of far polygons, where the
// arccosine of the usual formula has none left; the loops have no branch, for the compiler to
// vectorise.
float sum_edges(const Corners& v, std::size_t first, const vec3& normal) {
    std::array<float, kLanes> sine2, cosine, along, part;
    for (std::size_t k = 0; k < kLanes; ++k) {
        const std::size_t i = first + k;
        const vec3 c(v.y[i] * v.z[i + 1] - v.z[i] * v.y[i + 1],
                     v.z[i] * v.x[i + 1] - v.x[i] * v.z[i + 1],
                     v.x[i] * v.y[i + 1] - v.y[i] * v.x[i + 1]);
        sine2[k] = c.x * c.x + c.y * c.y + c.z * c.z;
        along[k] = c.x * normal.x + c.y * normal.y + c.z * normal.z;
        cosine[k] = v.x[i] * v.x[i + 1] + v.y[i] * v.y[i + 1] + v.z[i] * v.z[i + 1];
    }
    for (std::size_t k = 0; k < kLanes; ++k) {
        const float sine = std::sqrt(sine2[k]);
        const float size = std::abs(cosine[k]);
        const float small = sine < size ? sine : size;
        const float large = sine < size ? size : sine;
        const float t = small / (large + kTiny);
        const float octant = t * arctangent_share(t * t);
        const float quadrant = (sine < size ? 0 : kPi / 2) + (sine < size ? octant : -octant);
        const float angle = (cosine[k] < 0 ? kPi : 0) + (cosine[k] < 0 ? -quadrant : quadrant);
        part[k] = along[k] * (angle / (sine + kTiny));
    }
    return (part[0] + part[1]) + (part[2] + part[3]);
}

}  // namespace

float point_form_factor(const vec3& point, const vec3& normal, std::span<const vec3> corners) {
    Corners v = clip(point, normal, corners);
    if (v.count < 3) return 0;
    v.close();
    float sum = sum_edges(v, 0, normal);
    if (v.count > kLanes) sum += sum_edges(v, kLanes, normal);
    // Corners that run counter-clockwise as seen from their front run clockwise about the point.
    return -sum / (2 * kPi);
}

float far_form_factor(const vec3& point, const vec3& normal, const vec3& source_center,
                      const vec3& source_normal, float source_area) {
    const vec3 d = source_center - point;
    const float d2 = glm::dot(d, d);
    const float cos_receiver = std::max(0.0F, glm::dot(normal, d));
    return -source_area * cos_receiver * glm::dot(source_normal, d) / (kPi * d2 * d2);
}

}  // namespace antiradiance
