// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solve/solver.h"

namespace antiradiance {

// One pass of the + links alone (U L or G L): irradiance of every leaf, W/m2, for the given
// radiance of the leaves (#nodes, read at leaves). Without row scale; what row normalisation
// measures. rows: as Transport::leaf_irradiance() takes them.
std::vector<vec3> gather_once(const PatchTree& tree, const LinkSet& links,
                              std::span<const vec3> radiance, std::span<const std::uint8_t> rows,
                              Progress& progress);

}  // namespace antiradiance
