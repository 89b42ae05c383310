// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/triangulate.h"

#include <cmath>
#include <numeric>

namespace antiradiance {

namespace {

using glm::dvec2;
using glm::dvec3;

// Twice the polygon's area times its normal (Newell's method).
dvec3 area_vector(std::span<const vec3> corners) {
    dvec3 sum(0);
    dvec3 from(corners.back());
    for (const vec3& corner : corners) {
        const dvec3 to(corner);
        sum += glm::cross(from - dvec3(corners[0]), to - dvec3(corners[0]));
        from = to;
    }
    return sum;
}

// Along the axis that the normal is closest to; counter-clockwise stays so.
std::vector<dvec2> project(std::span<const vec3> corners) {
    const dvec3 n = area_vector(corners);
    const dvec3 size = glm::abs(n);
    const int axis = size.x > size.y && size.x > size.z ? 0 : (size.y > size.z ? 1 : 2);
    int u = (axis + 1) % 3;
    int v = (axis + 2) % 3;
    if (n[axis] < 0) std::swap(u, v);
    std::vector<dvec2> points;
    points.reserve(corners.size());
    for (const vec3& c : corners)
        points.emplace_back(c[u], c[v]);
    return points;
}

// Positive where a, b, c turn to the left.
double turn(const dvec2& a, const dvec2& b, const dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool is_inside(const dvec2& p, const dvec2& a, const dvec2& b, const dvec2& c) {
    return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

// Whether corner `at` of the polygon `rest` can be cut off: it turns to the left, and no other
// corner lies inside. Corners at one of its own places (a slit around a hole) do not count.
bool is_ear(const std::vector<dvec2>& points, const std::vector<std::uint32_t>& rest,
            std::size_t at) {
    const std::size_t count = rest.size();
    const dvec2 a = points[rest[(at + count - 1) % count]];
    const dvec2 b = points[rest[at]];
    const dvec2 c = points[rest[(at + 1) % count]];
    if (!(turn(a, b, c) > 0)) return false;
    for (std::size_t i = 2; i + 1 < count; ++i) {
        const dvec2 p = points[rest[(at + i) % count]];
        if (p != a && p != b && p != c && is_inside(p, a, b, c)) return false;
    }
    return true;
}

}  // namespace

std::vector<uvec3> triangulate(std::span<const vec3> corners) {
    std::vector<uvec3> triangles;
    if (corners.size() < 3) return triangles;
    const std::vector<dvec2> points = project(corners);
    std::vector<std::uint32_t> rest(corners.size());
    std::iota(rest.begin(), rest.end(), 0U);
    std::size_t at = 1;  // so that a convex polygon becomes the fan around its first corner
    std::size_t refused = 0;
    while (rest.size() > 3) {
        at %= rest.size();
        // Where no corner is an ear the polygon is broken: cut any.
        if (refused < rest.size() && !is_ear(points, rest, at)) {
            ++at;
            ++refused;
            continue;
        }
        const std::size_t count = rest.size();
        triangles.emplace_back(rest[(at + count - 1) % count], rest[at], rest[(at + 1) % count]);
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(at));
        refused = 0;
    }
    triangles.emplace_back(rest[0], rest[1], rest[2]);
    return triangles;
}

}  // namespace antiradiance
