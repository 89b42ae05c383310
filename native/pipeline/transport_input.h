// SPDX-License-Identifier: GPL-3.0-or-later
// What the leaves bring into the transport, from direct light and materials.
#pragma once

#include <span>
#include <vector>

#include "pipeline/model.h"
#include "solve/solver.h"

namespace antiradiance {

struct TransportInput {
    std::vector<vec3> source;  // #nodes, W/(m2 sr); set at leaves: reflected direct light, and
                               // emission unless shadow rays carry it; of the exposed part
    std::vector<vec3> albedo;  // #nodes, reflectance times exposed share

    // Borrows all: this, and what may be the model's or made from it.
    [[nodiscard]] TransportProblem problem(const PatchTree& tree, const LinkSet& links,
                                           std::span<const float> row_scale) const {
        return {tree, links, source, albedo, row_scale};
    }
};

// direct: #nodes, W/m2 on the exposed part of leaves (DirectLight::leaf_irradiance).
// scene: as for average_materials().
TransportInput make_transport_input(const Scene& scene, const PatchTree& tree,
                                    std::span<const vec3> direct, DirectLightMode mode);

}  // namespace antiradiance
