// SPDX-License-Identifier: GPL-3.0-or-later
// The structs and constants of shaders/display, as C++ sees them. The CPU's shooting and splatting
// take their constants from here too, so that both compute the same.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/types.h"

namespace antiradiance::glsl {

using uint = std::uint32_t;

#include "shaders/shared/display_layout.glsl"

// What std430 says of each struct (OpenGL 4.5 core, 7.6.2.2).
static_assert(sizeof(vec3) == 12 && sizeof(vec4) == 16);
static_assert(sizeof(Receiver) == 48 && offsetof(Receiver, surface) == 12 &&
              offsetof(Receiver, normal) == 16 && offsetof(Receiver, subset) == 28 &&
              offsetof(Receiver, shading) == 32 && offsetof(Receiver, unused) == 44);
static_assert(sizeof(WorkItem) == 16 && offsetof(WorkItem, receiver_count) == 4 &&
              offsetof(WorkItem, first_place) == 8 && offsetof(WorkItem, place_count) == 12);
static_assert(sizeof(Light) == 48 && offsetof(Light, radius) == 12 &&
              offsetof(Light, normal) == 16 && offsetof(Light, area) == 28 &&
              offsetof(Light, radiance) == 32 && offsetof(Light, surface) == 44);
static_assert(sizeof(Disk) == 48 && offsetof(Disk, radius) == 12 && offsetof(Disk, normal) == 16 &&
              offsetof(Disk, exposed) == 28 && offsetof(Disk, irradiance) == 32 &&
              offsetof(Disk, unused) == 44);
static_assert(sizeof(BinTexel) == 12 && offsetof(BinTexel, bins23) == 4 &&
              offsetof(BinTexel, shares) == 8);

}  // namespace antiradiance::glsl
