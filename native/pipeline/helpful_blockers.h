// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "hierarchy/patch_tree.h"
#include "links/blocking_planes.h"
#include "links/link_set.h"

namespace antiradiance {

// Which planes bring the light of IMPLICIT nearer to the truth, beside the others that do. A plane
// takes light away and the antiradiance that would have taken it back; where one end of a link is
// seen in part, past the edge of a wall, the sum may be for the worse, and with a thin board it
// often is. Greedy, from the plane that most links cross; to first order: what its links bring with
// the light as it is, without what less light does in further bounces.
// cut: #links, kNone where no plane crosses. radiance, error: #nodes, of IMPLICIT's solution
// without planes; its irradiance less the true one, at leaves, W/m2.  // #planes, 1: helps
[[nodiscard]] std::vector<std::uint8_t> find_helpful_blockers(
    const PatchTree& tree, const LinkSet& links, const BlockingPlanes& planes,
    std::size_t plane_count, std::span<const BlockerId> cut, std::span<const vec3> radiance,
    std::span<const vec3> error, Progress& progress);

}  // namespace antiradiance
