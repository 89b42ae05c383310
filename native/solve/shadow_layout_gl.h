// SPDX-License-Identifier: GPL-3.0-or-later
// The structs and constants of shaders/shadow, as C++ sees them.
#pragma once

#include <cstddef>

#include "base/types.h"

namespace antiradiance::glsl {

#include "shaders/shared/shadow_layout.glsl"

// What std140 and std430 say of each struct (OpenGL 4.5 core, 7.6.2.2). 256 is the largest
// alignment that a device may ask of uniform buffers.
static_assert(sizeof(ShadowView) == 64 && offsetof(ShadowView, scale) == 12 &&
              offsetof(ShadowView, y) == 16 && offsetof(ShadowView, near_end) == 28 &&
              offsetof(ShadowView, z) == 32 && offsetof(ShadowView, far_end) == 44 &&
              offsetof(ShadowView, origin) == 48 && offsetof(ShadowView, unused) == 60);
static_assert(sizeof(ShadowLight) == 512 && offsetof(ShadowLight, face_count) == 384 &&
              offsetof(ShadowLight, first_image) == 388 && offsetof(ShadowLight, unused) == 400);
static_assert(sizeof(LitPoint) == 32 && offsetof(LitPoint, unused_1) == 12 &&
              offsetof(LitPoint, normal) == 16 && offsetof(LitPoint, unused_2) == 28);

}  // namespace antiradiance::glsl
