// SPDX-License-Identifier: GPL-3.0-or-later
#include "hierarchy/patch_tree.h"

#include <algorithm>
#include <cmath>

namespace antiradiance {

namespace {

float cross2(const vec2& a, const vec2& b) {
    return a.x * b.y - a.y * b.x;
}

// (u, v) of a point in a convex planar quad, by Newton's method on the bilinear map.
vec2 inverse_bilinear(const Surface& s, const vec3& point) {
    const vec3 e1 = s.corners[1] - s.corners[0];
    const vec3 e2 = s.corners[3] - s.corners[0];
    const vec3 twist = s.corners[0] - s.corners[1] + s.corners[2] - s.corners[3];
    constexpr int kSteps = 6;  // quadratic convergence; a parallelogram needs one
    vec2 uv(0.5F);
    for (int i = 0; i < kSteps; ++i) {
        const vec3 at = s.corners[0] + e1 * uv.x + e2 * uv.y + twist * (uv.x * uv.y);
        const vec3 du = e1 + twist * uv.y;
        const vec3 dv = e2 + twist * uv.x;
        const vec3 d = point - at;
        const float a = glm::dot(du, du);
        const float b = glm::dot(du, dv);
        const float c = glm::dot(dv, dv);
        const float determinant = a * c - b * b;
        if (determinant <= 0) break;
        const float x = glm::dot(d, du);
        const float y = glm::dot(d, dv);
        const vec2 step((c * x - b * y) / determinant, (a * y - b * x) / determinant);
        uv = glm::clamp(uv + step, vec2(0), vec2(1));
        if (std::abs(step.x) + std::abs(step.y) < 1e-6F) break;
    }
    return uv;
}

vec2 inverse_barycentric(const Surface& s, const vec3& point) {
    const vec3 e1 = s.corners[1] - s.corners[0];
    const vec3 e2 = s.corners[2] - s.corners[0];
    const vec3 n = glm::cross(e1, e2);
    const vec3 d = point - s.corners[0];
    const float inverse = 1 / glm::dot(n, n);
    return {glm::dot(glm::cross(d, e2), n) * inverse, glm::dot(glm::cross(e1, d), n) * inverse};
}

// How far inside a region (u, v) lies; negative: outside. Only comparable between siblings.
float inside(const PatchRegion& region, int corner_count, const vec2& uv) {
    const auto& c = region.corners;
    if (corner_count == 4) {
        const vec2 d = glm::min(uv - c[0], c[2] - uv);
        return std::min(d.x, d.y);
    }
    const float whole = cross2(c[1] - c[0], c[2] - c[0]);
    float least = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        least = std::min(least, cross2(c[(i + 1) % 3] - c[i], uv - c[i]) / whole);
    }
    return least;
}

}  // namespace

bool PatchTree::emits_only(NodeId n) const {
    const SurfaceId s = surface[static_cast<std::size_t>(n)];
    return s != kNone && surfaces[static_cast<std::size_t>(s)].lamp != kNone;
}

vec3 PatchTree::surface_point(SurfaceId id, const vec2& uv) const {
    const Surface& s = surfaces[static_cast<std::size_t>(id)];
    if (s.corner_count == 4) {
        return glm::mix(glm::mix(s.corners[0], s.corners[1], uv.x),
                        glm::mix(s.corners[3], s.corners[2], uv.x), uv.y);
    }
    return s.corners[0] * (1 - uv.x - uv.y) + s.corners[1] * uv.x + s.corners[2] * uv.y;
}

int PatchTree::corner_count(NodeId n) const {
    const SurfaceId s = surface[static_cast<std::size_t>(n)];
    return s == kNone ? 0 : surfaces[static_cast<std::size_t>(s)].corner_count;
}

std::array<vec3, 4> PatchTree::patch_corners(NodeId n) const {
    std::array<vec3, 4> corners{};
    for (int i = 0; i < corner_count(n); ++i) {
        const auto k = static_cast<std::size_t>(i);
        corners[k] = surface_point(surface[static_cast<std::size_t>(n)],
                                   region[static_cast<std::size_t>(n)].corners[k]);
    }
    return corners;
}

vec3 PatchTree::patch_point(NodeId n, const vec2& sample) const {
    const auto i = static_cast<std::size_t>(n);
    const auto& c = region[i].corners;
    vec2 uv;
    if (corner_count(n) == 4) {
        uv = glm::mix(c[0], c[2], sample);
    } else {
        // Square to triangle with little distortion, so that strata stay compact (Heitz 2019).
        vec2 t = sample;
        if (t.y > t.x) {
            t.x *= 0.5F;
            t.y -= t.x;
        } else {
            t.y *= 0.5F;
            t.x -= t.y;
        }
        uv = c[0] * (1 - t.x - t.y) + c[1] * t.x + c[2] * t.y;
    }
    return surface_point(surface[i], uv);
}

NodeId PatchTree::lookup(TriangleId triangle, bool back_side, const vec3& point) const {
    const SurfaceId id = triangle_surface[static_cast<std::size_t>(triangle)][back_side ? 1 : 0];
    if (id == kNone) return kNone;
    const Surface& s = surfaces[static_cast<std::size_t>(id)];
    NodeId n = surface_node[static_cast<std::size_t>(id)];
    if (is_leaf(n)) return n;
    const vec2 uv =
        s.corner_count == 4 ? inverse_bilinear(s, point) : inverse_barycentric(s, point);
    while (!is_leaf(n)) {
        const NodeId end = subtree_end[static_cast<std::size_t>(n)];
        NodeId best = n + 1;
        float best_inside = inside(region[static_cast<std::size_t>(best)], s.corner_count, uv);
        for (NodeId child = subtree_end[static_cast<std::size_t>(best)];
             child < end && best_inside < 0; child = subtree_end[static_cast<std::size_t>(child)]) {
            const float now = inside(region[static_cast<std::size_t>(child)], s.corner_count, uv);
            if (now > best_inside) {
                best = child;
                best_inside = now;
            }
        }
        n = best;
    }
    return n;
}

}  // namespace antiradiance
