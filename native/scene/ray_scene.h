// SPDX-License-Identifier: GPL-3.0-or-later
// Rays against the original triangles (Embree 3 or 4). The only file pair that knows Embree.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "scene/scene.h"

namespace antiradiance {

struct RayHit {
    TriangleId triangle = kNone;  // kNone: nothing hit
    bool back_side = false;       // the triangle was hit from behind
    vec2 barycentric{0};          // weights of corners 1 and 2
    float distance = 0;           // m
    [[nodiscard]] bool hit() const { return triangle != kNone; }
};

struct ShadowRay {
    vec3 from, to;  // m
};

class RayScene {
public:
    // Borrows nothing: copies what it needs. Builds on all cores.
    explicit RayScene(const Scene& scene);
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    // `direction` is unit length. From any thread.
    [[nodiscard]] RayHit intersect(const vec3& origin, const vec3& direction, float near = 0,
                                   float far = kInfinity) const;
    // True when a triangle blocks the open segment from a to b. Both ends are pulled in by
    // epsilon(), so surfaces that hold a or b do not count; offset a and b along their own normals
    // by epsilon() first when they lie on a surface.
    [[nodiscard]] bool occluded(const vec3& a, const vec3& b) const;
    // blocked[i] = occluded(rays[i].from, rays[i].to), in packets: faster where rays that follow
    // each other run side by side.
    void occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> blocked) const;
    // Towards infinity.
    [[nodiscard]] bool escapes(const vec3& origin, const vec3& direction) const;

    // A point, m, on the ray behind which the scene has nothing; for an origin inside its bounds.
    [[nodiscard]] vec3 beyond(const vec3& origin, const vec3& direction) const {
        return origin + direction * (2e5F * epsilon_);
    }

    // m, the length below which two points count as one: 1e-5 of the scene's largest extent, and no
    // less than float can tell apart where the scene lies.
    [[nodiscard]] float epsilon() const { return epsilon_; }
    // m, of the scene with that epsilon.
    [[nodiscard]] static float extent_of(float epsilon) { return epsilon / kEpsilonShare; }

    static constexpr float kInfinity = 1e30F;

private:
    static constexpr float kEpsilonShare = 1e-5F;
    struct Impl;
    std::unique_ptr<Impl> impl_;
    float epsilon_ = 0;
};

}  // namespace antiradiance
