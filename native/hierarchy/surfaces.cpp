// SPDX-License-Identifier: GPL-3.0-or-later
#include "hierarchy/surfaces.h"

#include <algorithm>
#include <cmath>

#include "scene/lamp.h"

namespace antiradiance {

namespace {

constexpr float kCoplanarCosine = 0.99985F;  // 1 degree
constexpr float kLeastSine = 0.01F;          // of a quad's corner angle: no needles

vec3 triangle_area_vector(const std::array<vec3, 3>& c) {
    return 0.5F * glm::cross(c[1] - c[0], c[2] - c[0]);
}

// Two triangles on both sides of an edge, as a candidate quad.
struct QuadCandidate {
    TriangleId a, b;
    std::array<vec3, 4> corners;
    float edge_length;
    bool same_polygon;
};

struct Edge {
    vec3 low, high;  // end points, lexicographically ordered
    TriangleId triangle;
    std::int32_t corner;  // the edge runs from corner to corner + 1
};

bool less(const vec3& a, const vec3& b) {
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    return a.z < b.z;
}

bool is_convex(const std::array<vec3, 4>& quad, const vec3& normal) {
    for (std::size_t i = 0; i < 4; ++i) {
        const vec3 before = quad[i] - quad[(i + 3) % 4];
        const vec3 after = quad[(i + 1) % 4] - quad[i];
        const float turn = glm::dot(glm::cross(before, after), normal);
        if (turn < kLeastSine * glm::length(before) * glm::length(after)) return false;
    }
    return true;
}

// Edges of all triangles, those at one place next to each other.
std::vector<Edge> sorted_edges(const Scene& scene) {
    std::vector<Edge> edges;
    edges.reserve(scene.triangles.size() * 3);
    for (TriangleId t = 0; t < static_cast<TriangleId>(scene.triangles.size()); ++t) {
        const auto c = scene.corners(t);
        for (std::int32_t i = 0; i < 3; ++i) {
            const vec3& from = c[static_cast<std::size_t>(i)];
            const vec3& to = c[static_cast<std::size_t>((i + 1) % 3)];
            const bool ordered = less(from, to);
            edges.push_back({ordered ? from : to, ordered ? to : from, t, i});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        if (a.low != b.low) return less(a.low, b.low);
        if (a.high != b.high) return less(a.high, b.high);
        return a.triangle < b.triangle;
    });
    return edges;
}

bool make_candidate(const Scene& scene, const Edge& e, const Edge& f, QuadCandidate& quad) {
    const auto a = static_cast<std::size_t>(e.triangle);
    const auto b = static_cast<std::size_t>(f.triangle);
    if (scene.triangle_object[a] != scene.triangle_object[b] ||
        scene.triangle_material[a] != scene.triangle_material[b])
        return false;
    const auto ca = scene.corners(e.triangle);
    const auto cb = scene.corners(f.triangle);
    const vec3 area_a = triangle_area_vector(ca);
    const vec3 area_b = triangle_area_vector(cb);
    if (glm::dot(area_a, area_b) < kCoplanarCosine * glm::length(area_a) * glm::length(area_b))
        return false;
    // Around the quad: the shared edge's start, b's free corner, the edge's end, a's free corner.
    const auto i = static_cast<std::size_t>(e.corner);
    const auto j = static_cast<std::size_t>(f.corner);
    quad.corners = {ca[i], cb[(j + 2) % 3], ca[(i + 1) % 3], ca[(i + 2) % 3]};
    if (!is_convex(quad.corners, glm::normalize(area_a + area_b))) return false;
    quad.a = e.triangle;
    quad.b = f.triangle;
    quad.edge_length = glm::distance(e.low, e.high);
    quad.same_polygon = scene.triangle_polygon[a] == scene.triangle_polygon[b];
    return true;
}

std::vector<QuadCandidate> quad_candidates(const Scene& scene) {
    const std::vector<Edge> edges = sorted_edges(scene);
    std::vector<QuadCandidate> candidates;
    for (std::size_t begin = 0; begin < edges.size();) {
        std::size_t end = begin + 1;
        while (end < edges.size() && edges[end].low == edges[begin].low &&
               edges[end].high == edges[begin].high)
            ++end;
        // More than two triangles at an edge: a junction of walls, where pairing is a guess.
        QuadCandidate quad;
        if (end - begin == 2 && make_candidate(scene, edges[begin], edges[begin + 1], quad))
            candidates.push_back(quad);
        begin = end;
    }
    std::sort(candidates.begin(), candidates.end(),
              [](const QuadCandidate& x, const QuadCandidate& y) {
                  if (x.same_polygon != y.same_polygon) return x.same_polygon;
                  if (x.edge_length != y.edge_length) return x.edge_length > y.edge_length;
                  return x.a < y.a;
              });
    return candidates;
}

}  // namespace

vec3 Polygon::area_vector() const {
    if (corner_count == 4)
        return 0.5F * glm::cross(corners[2] - corners[0], corners[3] - corners[1]);
    return 0.5F * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
}

std::vector<Polygon> make_polygons(const Scene& scene) {
    std::vector<Polygon> polygons;
    std::vector<char> used(scene.triangles.size(), 0);
    for (const QuadCandidate& quad : quad_candidates(scene)) {
        char& a = used[static_cast<std::size_t>(quad.a)];
        char& b = used[static_cast<std::size_t>(quad.b)];
        if (a || b) continue;
        a = b = 1;
        polygons.push_back({quad.corners, {quad.a, quad.b}, 4});
    }
    for (TriangleId t = 0; t < static_cast<TriangleId>(scene.triangles.size()); ++t) {
        if (used[static_cast<std::size_t>(t)]) continue;
        const auto c = scene.corners(t);
        polygons.push_back({{c[0], c[1], c[2], c[2]}, {t, kNone}, 3});
    }
    std::sort(polygons.begin(), polygons.end(),
              [](const Polygon& a, const Polygon& b) { return a.triangles[0] < b.triangles[0]; });
    return polygons;
}

Surface make_surface(const Scene& scene, const Polygon& polygon, bool back_side) {
    const auto t = static_cast<std::size_t>(polygon.triangles[0]);
    Surface s;
    s.corners = polygon.corners;
    if (back_side) std::reverse(s.corners.begin(), s.corners.begin() + polygon.corner_count);
    s.triangles = polygon.triangles;
    s.corner_count = polygon.corner_count;
    s.material = scene.triangle_material[t];
    s.object = scene.triangle_object[t];
    s.back_side = back_side;
    s.emits = scene.materials[static_cast<std::size_t>(s.material)].emits();
    return s;
}

vec3 surface_center(const Surface& s) {
    vec3 sum(0);
    for (int i = 0; i < s.corner_count; ++i)
        sum += s.corners[static_cast<std::size_t>(i)];
    return sum / static_cast<float>(s.corner_count);
}

vec3 surface_area_vector(const Surface& s) {
    if (s.corner_count == 4)
        return 0.5F * glm::cross(s.corners[2] - s.corners[0], s.corners[3] - s.corners[1]);
    return 0.5F * glm::cross(s.corners[1] - s.corners[0], s.corners[2] - s.corners[0]);
}

Surface make_lamp_surface(const Lamp& lamp, std::int32_t lamp_index) {
    // An ellipse has pi/4 of the area of the rectangle around it.
    const float shrink = lamp.shape == AreaShape::kEllipse ? std::sqrt(kPi) / 2 : 1.0F;
    const vec3 center = lamp_position(lamp);
    Surface s;
    s.corners = area_lamp_corners(lamp);
    for (vec3& corner : s.corners)
        corner = center + (corner - center) * shrink;
    s.corner_count = 4;
    s.lamp = lamp_index;
    s.emits = true;
    return s;
}

}  // namespace antiradiance
