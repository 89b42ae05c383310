// SPDX-License-Identifier: GPL-3.0-or-later
// Vector types and the constants that every stage shares.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>

namespace antiradiance {

using glm::ivec2;
using glm::mat4;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kInvPi = std::numbers::inv_pi_v<float>;

using TriangleId = std::int32_t;  // index into Scene::triangles
using SurfaceId = std::int32_t;   // index into PatchTree::surfaces
using NodeId = std::int32_t;      // index into PatchTree's node arrays (preorder)
inline constexpr std::int32_t kNone = -1;

// Rec.709 luminance of linear RGB.
inline float luminance(const vec3& rgb) {
    return 0.2126F * rgb.x + 0.7152F * rgb.y + 0.0722F * rgb.z;
}

inline float max_component(const vec3& v) {
    return glm::max(v.x, glm::max(v.y, v.z));
}

}  // namespace antiradiance
