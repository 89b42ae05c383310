// SPDX-License-Identifier: GPL-3.0-or-later
#include "hierarchy/shaft.h"

#include <algorithm>

namespace antiradiance {

bool ShaftTest::heights(const ConvexRegion& region, std::span<const vec3> points, float side,
                        std::vector<float>& result) const {
    result.resize(points.size());
    float highest = 0;
    float lowest = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float h = side * (glm::dot(region.normal, points[i]) - region.offset);
        highest = std::max(highest, h);
        lowest = std::min(lowest, h);
        result[i] = std::max(h, 0.0F);
    }
    return lowest >= -regions_.tolerance && highest > regions_.tolerance;
}

bool ShaftTest::blocks(RegionId region, std::span<const vec3> from, std::span<const vec3> to) {
    const ConvexRegion& plane = regions_.regions[static_cast<std::size_t>(region)];
    vec3 sum(0);
    for (const vec3& p : from)
        sum += p;
    const float side =
        regions_.height(region, sum / static_cast<float>(from.size())) > 0 ? 1.0F : -1.0F;
    if (!heights(plane, from, side, from_height_) || !heights(plane, to, -side, to_height_))
        return false;

    const auto distances = [](const vec4& edge, std::span<const vec3> points,
                              std::vector<float>& result) {
        result.resize(points.size());
        float least = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            result[i] = glm::dot(vec3(edge), points[i]) + edge.w;
            least = std::min(least, result[i]);
        }
        return least;
    };
    for (const vec4& edge : regions_.edges_of(region)) {
        const float least =
            std::min(distances(edge, from, from_distance_), distances(edge, to, to_distance_));
        if (least >= -regions_.tolerance) continue;
        // The segment's distance from the edge where it meets the plane, times the sum of heights.
        for (std::size_t i = 0; i < from.size(); ++i) {
            for (std::size_t k = 0; k < to.size(); ++k) {
                const float inside =
                    to_height_[k] * from_distance_[i] + from_height_[i] * to_distance_[k];
                if (inside < -regions_.tolerance * (from_height_[i] + to_height_[k])) return false;
            }
        }
    }
    return true;
}

}  // namespace antiradiance
