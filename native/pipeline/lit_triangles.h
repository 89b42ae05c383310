// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "scene/scene.h"

namespace antiradiance {

// Which sides of the triangles light reaches (find_lit_sides()): front, back.  // #triangles
// `scene` is valid (see validate()).
[[nodiscard]] std::vector<std::array<std::uint8_t, 2>> find_lit_triangles(const Scene& scene,
                                                                          Progress& progress);

}  // namespace antiradiance
