// SPDX-License-Identifier: GPL-3.0-or-later
// A scene taken through the stages of a render up to the solver, with every leaf's light at hand.
#pragma once

#include <vector>

#include "pipeline/model.h"
#include "pipeline/transport_input.h"
#include "solve/solver.h"

namespace antiradiance::test {

struct LitScene {
    Scene scene;
    Model model;
    std::vector<vec3> direct;  // #nodes, W/m2 at leaves
    TransportInput input;

    LitScene(const Scene& scene, const Options& options);
    [[nodiscard]] TransportProblem problem() const {
        return input.problem(model.tree, model.links, model.row_scale);
    }

    // W/(m2 sr) that the exposed part of every leaf sends out in all.   // #nodes, set at leaves
    [[nodiscard]] std::vector<vec3> radiance(const Solution& solution) const;
    // W/m2 of direct and indirect light.                                // #nodes, set at leaves
    [[nodiscard]] std::vector<vec3> total_irradiance(const Solution& solution) const;
};

// Over leaves with an exposed part, weighted by it.
struct Statistics {
    double mean = 0, least = 0, most = 0;
    double deviation = 0;  // root mean square of value / mean - 1
};
// values: #nodes; read in red.
Statistics statistics(const PatchTree& tree, const std::vector<NodeId>& leaves,
                      const std::vector<vec3>& values);

// Fails unless all values are finite and none is negative.
void expect_light(const std::vector<vec3>& values);

}  // namespace antiradiance::test
