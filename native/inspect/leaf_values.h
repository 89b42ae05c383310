// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers behind the inspection modes (inspect/inspect.h), leaf by leaf.
#pragma once

#include <vector>

#include "base/progress.h"
#include "pipeline/solved_scene.h"

namespace antiradiance {

// The node `level` steps above: 0 is the node itself, then patches up to the whole surface, then
// clusters. The root where there are fewer.
[[nodiscard]] NodeId ancestor(const PatchTree& tree, NodeId node, int level);

// From how many levels on ancestor() is the root for every leaf: 1 + the depth of the deepest; 0
// for an empty tree.
[[nodiscard]] int level_count(const PatchTree& tree);

// Irradiance that links bring to the leaves by one more pass over the solution, W/m2: that of
// light->irradiance where it has converged, but negative where antiradiance wins.
// Antiradiance is the one that belongs to the solution's radiance.     // #nodes, 0 at inner nodes
[[nodiscard]] std::vector<vec3> regathered_irradiance(const SolvedScene& solved,
                                                      Progress& progress);

// The part of it that arrives in one direction bin of solved.links(), by the links of the leaf and
// of all its ancestors. All bins add up to regathered_irradiance(), exactly where no link ends at a
// cluster, whose light is clamped at 0 for each sum by itself. A bin that there is not: the last.
[[nodiscard]] std::vector<vec3> bin_irradiance(const SolvedScene& solved, int bin,
                                               Progress& progress);

// |L' - L| of the leaves, the largest of the colours, relative to the largest L of any leaf; L' is
// what one more pass makes of the solution's L. Where the solver has converged, less than its
// tolerance.                                                           // #nodes, 0 at inner nodes
[[nodiscard]] std::vector<float> residuals(const SolvedScene& solved, Progress& progress);

// How much brighter links make the leaves than in `truth`, which has the same geometry: luminance
// of the irradiance less truth's mean over the leaf, relative to the mean of truth's direct and
// indirect irradiance over all surfaces. Below 0: darker.
// Direct light has no part in it: both have the same, but for the sizes of the leaves.
// Throws std::invalid_argument when the geometries differ.             // #nodes, 0 at inner nodes
[[nodiscard]] std::vector<float> irradiance_differences(const SolvedScene& solved,
                                                        const SolvedScene& truth,
                                                        Progress& progress);

}  // namespace antiradiance
