// SPDX-License-Identifier: GPL-3.0-or-later
// The structs and constants of shaders/solve, as C++ sees them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "base/types.h"

namespace antiradiance::glsl {

using uint = std::uint32_t;

#include "shaders/shared/transport_layout.glsl"

// What std430 says of each struct (OpenGL 4.5 core, 7.6.2.2).
static_assert(sizeof(vec3) == 12 && sizeof(vec4) == 16);
static_assert(sizeof(Link) == 8 && offsetof(Link, form_factor) == 4);
static_assert(sizeof(Segment) == 16 && offsetof(Segment, first_link) == 4 &&
              offsetof(Segment, bin_and_count) == 8 && offsetof(Segment, inv_c) == 12);
static_assert(sizeof(Node) == 16 && offsetof(Node, subtree_end) == 4 && offsetof(Node, area) == 8 &&
              offsetof(Node, cluster) == 12);
static_assert(sizeof(Leaf) == 32 && offsetof(Leaf, node) == 12 &&
              offsetof(Leaf, reflectance) == 16 && offsetof(Leaf, row_scale) == 28);
static_assert(sizeof(SurfaceNode) == 16 && offsetof(SurfaceNode, node) == 12);
static_assert(sizeof(PassState) == 32 && offsetof(PassState, max_change) == 12 &&
              offsetof(PassState, max_gained) == 16 && offsetof(PassState, unused) == 28);

}  // namespace antiradiance::glsl
