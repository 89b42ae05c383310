// SPDX-License-Identifier: GPL-3.0-or-later
// The furnished room, taken through the stages before the one that is measured: 10 to 13 thousand
// leaves and about a hundred links a leaf, like the paper's scenes.
#pragma once

#include <memory>
#include <vector>

#include "pipeline/model.h"
#include "pipeline/transport_input.h"
#include "solve/direct_light.h"
#include "solve/solver.h"

namespace antiradiance::bench {

struct Stages {
    explicit Stages(Visibility visibility);

    Options options;
    Scene scene;
    Model model;
    std::unique_ptr<DirectLight> direct;
    TransportInput input;

    [[nodiscard]] TransportProblem problem() const {
        return input.problem(model.tree, model.links, model.row_scale);
    }
};

// Made on first use.
const Stages& stages(Visibility visibility);

}  // namespace antiradiance::bench
