// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "hierarchy/patch_tree.h"
#include "solve/solve_options.h"

namespace antiradiance {

// What a TransportProblem asks for beside the links; buried parts of leaves neither send nor
// reflect.
struct TransportInput {
    // Radiance that enters the links at leaves, W/(m2 sr): reflected direct light, and emission
    // unless shadow rays carry it.                                                     // #nodes
    std::vector<vec3> source;
    std::vector<vec3> albedo;  // of leaves, times the exposed share                    // #nodes
};

// direct: irradiance of every leaf's exposed part by shadow rays, W/m2.  // #nodes
[[nodiscard]] TransportInput transport_input(const PatchTree& tree, std::span<const vec3> direct,
                                             DirectLightMode mode);

}  // namespace antiradiance
