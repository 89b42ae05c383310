// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "base/progress.h"
#include "hierarchy/surfaces.h"
#include "scene/ray_scene.h"

namespace antiradiance {

// Which sides of the polygons any light path can reach.                 // #polygons: front, back
//
// Every polygon side is its own candidate: guessing whether a mesh is closed fails on rooms made
// from one cube, on flipped normals and on single planes. Paths of light from the lamps, the
// emissive sides and what the sun shines on tell where light gets to, from point to point, so that
// the lit part of a floor lights nothing inside of a block that stands on it. Small sides that no
// path meets look around for lit ones. A side that no light reaches takes no part in the transport:
// it is the inside of a solid or the far face of a wall, and would only leak.
//
// Monte Carlo with fixed seeds: a side that is seen through less than about 1 % of its hemisphere
// may be missed.
std::vector<std::array<bool, 2>> find_lit_sides(const Scene& scene, const RayScene& rays,
                                                const std::vector<Polygon>& polygons,
                                                Progress& progress);

}  // namespace antiradiance
