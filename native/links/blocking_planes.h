// SPDX-License-Identifier: GPL-3.0-or-later
// The artist's blocking planes: where no link can go (Mückl & Dachsbacher, section 4.3).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hierarchy/convex_regions.h"
#include "scene/ray_scene.h"
#include "scene/scene.h"

namespace antiradiance {

using BlockerId = std::int32_t;  // index into Scene::blockers

class BlockingPlanes {
public:
    BlockingPlanes() = default;  // none: nothing is cut
    // epsilon: m; what lies nearer to a plane lies on it (RayScene::epsilon() of the scene).
    BlockingPlanes(std::span<const Blocker> blockers, float epsilon);

    [[nodiscard]] bool empty() const { return triangle_blocker_.empty(); }

    // The first plane on the way from a to b, m; kNone: the segment is free. What ends on a plane
    // does not cross it: a patch with its centre on one is lit from both sides. From any thread.
    [[nodiscard]] BlockerId crossed(const vec3& a, const vec3& b) const;

    // All of them, each once, in the order in which they are met, but one of those that lie at one
    // place.
    void all_crossed(const vec3& a, const vec3& b, std::vector<BlockerId>& planes) const;

    // A convex hull, m, and a point in it.
    struct Hull {
        vec3 center;
        std::span<const vec3> corners;
    };
    // The plane of which one convex part crosses all segments between two hulls; kNone: that which
    // the segment between their centres meets first does not, or there is none. Planes that touch
    // in one plane may make up one part; it counts for the one that is met. From any thread.
    [[nodiscard]] BlockerId separating(const Hull& a, const Hull& b) const;

    // Whether a plane may come nearer to a point than `distance`, m. Never false by mistake. Looks
    // at every triangle.
    [[nodiscard]] bool near(const vec3& point, float distance) const;

private:
    [[nodiscard]] RayHit first_hit(const vec3& a, const vec3& b) const;

    struct Triangle {
        vec3 low, high;  // m, of its box
        vec3 normal;     // unit
        float offset;    // m: normal . p on its plane
    };
    std::vector<BlockerId> triangle_blocker_;  // #triangles of all blockers
    ConvexRegions regions_;                    // of_surface: #triangles
    std::vector<Triangle> triangles_;
    std::optional<RayScene> rays_;
    float epsilon_ = 0;  // m
};

}  // namespace antiradiance
