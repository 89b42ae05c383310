// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "base/progress.h"
#include "prune/prune.h"

namespace antiradiance {

// Links that never carry anything while the direct light stays as it is ("Patches without incoming
// links", end of section 4.2): those out of patches that neither send light of their own nor
// receive any over + links from patches that do, however many bounces away. + links out of black
// patches as well. The solution does not change: what a patch receives over - links alone is
// negative, and solvers clamp it to 0.
// source, albedo: #nodes, read at leaves, as in TransportProblem (solve/solver.h).
// #links, 1: to be removed. A later change of the light needs the whole set again.
RemovedLinks find_dark_links(const PatchTree& tree, const LinkSet& links,
                             std::span<const vec3> source, std::span<const vec3> albedo,
                             Progress& progress);

}  // namespace antiradiance
