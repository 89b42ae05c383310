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

    // Borrows this, the model and the links: the model's, or those that pruning left of them.
    [[nodiscard]] TransportProblem problem(const Model& model, const LinkSet& links) const {
        return {model.tree, links, source, albedo, model.row_scale};
    }
    [[nodiscard]] TransportProblem problem(const Model& model) const {
        return problem(model, model.links);
    }
};

// direct: #nodes, W/m2 on the exposed part of leaves (DirectLight::leaf_irradiance).
// scene: as for average_materials().
TransportInput make_transport_input(const Scene& scene, const PatchTree& tree,
                                    std::span<const vec3> direct, DirectLightMode mode);

}  // namespace antiradiance
