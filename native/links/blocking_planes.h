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
    // does not cross it. From any thread.
    [[nodiscard]] BlockerId crossed(const vec3& a, const vec3& b) const;

    // All of them, each once, in the order in which they are met.
    void all_crossed(const vec3& a, const vec3& b, std::vector<BlockerId>& planes) const;

    // A convex hull, m, and a point in it.
    struct Hull {
        vec3 center;
        std::span<const vec3> corners;
    };
    // The plane of which one convex part crosses all segments between two hulls; kNone: that which
    // the segment between their centres meets first does not, or there is none. From any thread.
    [[nodiscard]] BlockerId separating(const Hull& a, const Hull& b) const;

    // Whether a plane may come nearer to a point than `distance`, m. Never false by mistake.
    [[nodiscard]] bool near(const vec3& point, float distance) const;

private:
    [[nodiscard]] RayHit first_hit(const vec3& a, const vec3& b) const;

    struct Box {
        vec3 low, high;  // m
    };
    std::vector<BlockerId> triangle_blocker_;  // #triangles of all blockers
    ConvexRegions regions_;                    // of_surface: #triangles
    std::vector<Box> boxes_;                   // #regions
    std::optional<RayScene> rays_;
    float epsilon_ = 0;  // m
};

}  // namespace antiradiance
