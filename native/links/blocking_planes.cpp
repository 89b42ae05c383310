// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/blocking_planes.h"

#include <algorithm>
#include <cmath>

#include "hierarchy/shaft.h"

namespace antiradiance {

BlockingPlanes::BlockingPlanes(std::span<const Blocker> blockers, float epsilon)
    : epsilon_(epsilon) {
    Scene planes;
    for (std::size_t b = 0; b < blockers.size(); ++b) {
        MeshInput mesh;
        mesh.positions = blockers[b].positions.data();
        mesh.position_count = blockers[b].positions.size();
        mesh.triangles = blockers[b].triangles.data();
        mesh.triangle_count = blockers[b].triangles.size();
        add_mesh(planes, mesh);
        triangle_blocker_.resize(planes.triangles.size(), static_cast<BlockerId>(b));
    }
    if (empty()) return;
    std::vector<Surface> triangles(planes.triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        triangles[t].triangles[0] = static_cast<TriangleId>(t);
    regions_ = find_convex_regions(planes, triangles, RayScene::extent_of(epsilon));
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto [a, b, c] = planes.corners(static_cast<TriangleId>(t));
        const vec3 normal = glm::normalize(glm::cross(b - a, c - a));
        triangles_.push_back({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), normal,
                              glm::dot(normal, a)});
    }
    rays_.emplace(planes);
}

RayHit BlockingPlanes::first_hit(const vec3& a, const vec3& b) const {
    const vec3 d = b - a;
    const float length = glm::length(d);
    if (empty() || length <= 2 * epsilon_) return {};
    return rays_->intersect(a, d / length, epsilon_, length - epsilon_);
}

BlockerId BlockingPlanes::crossed(const vec3& a, const vec3& b) const {
    const RayHit hit = first_hit(a, b);
    return hit.hit() ? triangle_blocker_[static_cast<std::size_t>(hit.triangle)] : kNone;
}

void BlockingPlanes::all_crossed(const vec3& a, const vec3& b,
                                 std::vector<BlockerId>& planes) const {
    planes.clear();
    vec3 from = a;
    for (RayHit hit = first_hit(from, b); hit.hit(); hit = first_hit(from, b)) {
        const BlockerId plane = triangle_blocker_[static_cast<std::size_t>(hit.triangle)];
        if (std::ranges::find(planes, plane) == planes.end()) planes.push_back(plane);
        from += glm::normalize(b - from) * hit.distance;
    }
}

BlockerId BlockingPlanes::separating(const Hull& a, const Hull& b) const {
    const RayHit hit = first_hit(a.center, b.center);
    if (!hit.hit()) return kNone;
    const auto t = static_cast<std::size_t>(hit.triangle);
    const RegionId region = regions_.of_surface[t];
    if (region == kNone || !ShaftTest(regions_).blocks(region, a.corners, b.corners)) return kNone;
    return triangle_blocker_[t];
}

bool BlockingPlanes::near(const vec3& point, float distance) const {
    const float reach = distance + epsilon_;
    return std::ranges::any_of(triangles_, [&](const Triangle& t) {
        if (std::abs(glm::dot(t.normal, point) - t.offset) > reach) return false;
        const vec3 d = glm::max(glm::max(t.low - point, point - t.high), vec3(0));
        return glm::dot(d, d) <= reach * reach;
    });
}

}  // namespace antiradiance
