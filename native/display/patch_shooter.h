// SPDX-License-Identifier: GPL-3.0-or-later
// How one patch lights fragments, in two ways: with the antiradiance that it sends on behind it,
// or with shadow rays.
#pragma once

#include <cmath>
#include <memory>
#include <span>

#include "display/bin_weights.h"
#include "display/patch_lights.h"
#include "hierarchy/patch_tree.h"
#include "scene/ray_scene.h"
#include "solve/antiradiance_table.h"
#include "solve/moments.h"

namespace antiradiance {

// A fragment that patches light, one after the other.
struct Receiver {
    vec3 position;       // m
    vec3 normal;         // unit, of the geometry: sets the horizon
    vec3 shading;        // unit, sets the cosine
    SurfaceId surface;   // kNone: on a side that no link reaches
    std::uint32_t turn;  // where its choice among a patch's points begins
    float expected;      // W/m2, luminance of about all light that its share of the
                         // patches stands for
    float rays_owed;     // 0..1, for the light of weak patches so far
    vec3 irradiance{0};  // W/m2, the result
};

// cos cos / d^2 between a point of a patch and a receiver, 1/m2; d: from the patch to the receiver.
inline float transfer(const Receiver& r, const vec3& patch_normal, const vec3& d, float d2) {
    const float cos_r = -glm::dot(d, r.shading);
    if (cos_r <= 0 || glm::dot(d, r.normal) >= 0) return 0;
    return std::abs(glm::dot(d, patch_normal)) * cos_r / (d2 * d2);
}

// cos / d^2 at a receiver of a light without extent, 1/m2.
inline float transfer_from_point(const Receiver& r, const vec3& d, float d2) {
    const float cos_r = -glm::dot(d, r.shading);
    if (cos_r <= 0 || glm::dot(d, r.normal) >= 0) return 0;
    return cos_r / (d2 * std::sqrt(d2));
}

// For one thread.
class PatchShooter {
public:
    virtual ~PatchShooter() = default;
    // Adds the light of a patch to receivers that lie close together. They stay where they are
    // until finish(), which may be what adds it.
    virtual void light(NodeId source, std::span<Receiver> receivers) = 0;
    virtual void finish() {}
};

// Radiance in front of each patch, antiradiance behind it (the paper's section 5).
// epsilon: m, heights above a plane that rounding explains.
[[nodiscard]] std::unique_ptr<PatchShooter> make_antiradiance_shooter(
    const PatchTree& tree, const PatchLights& lights, const AntiradianceTable& antiradiance,
    const BinWeights& bins, float epsilon);

// Radiance alone, where a shadow ray says that it arrives. clusters: #nodes, pull_moments().
[[nodiscard]] std::unique_ptr<PatchShooter> make_ray_shooter(const PatchTree& tree,
                                                             const PatchLights& lights,
                                                             std::span<const Moments> clusters,
                                                             const RayScene& rays);

}  // namespace antiradiance
