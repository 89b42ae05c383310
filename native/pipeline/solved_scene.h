// SPDX-License-Identifier: GPL-3.0-or-later
// A scene and its light: what the stages made of it (pipeline/stages.h), and all that pictures of
// it need beside a camera.
//
// Nothing in it changes: copies share it, and whoever shows it keeps it while the stages make the
// next one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pipeline/evaluate_rules.h"
#include "pipeline/model.h"
#include "pipeline/report.h"
#include "pipeline/stage_input.h"
#include "pipeline/transport_input.h"
#include "prune/prune.h"
#include "solve/direct_light.h"
#include "solve/mixed_visibility.h"

namespace antiradiance {

struct SolvedScene {
    std::shared_ptr<const StageInput> input;
    // By stage; null before it has run.
    std::shared_ptr<const Model> model;
    std::shared_ptr<const PruneResult> pruned;  // null: all of the model's links take part
    std::shared_ptr<const DirectLight> direct;  // borrows the model's rays
    std::shared_ptr<const std::vector<vec3>> leaf_direct;  // #nodes, W/m2 of it on each leaf
    std::shared_ptr<const LightShares> light_shares;       // of leaf_direct
    std::shared_ptr<const TransportInput> transport;
    std::shared_ptr<const LinkSet> lit_links;      // null: no dark links were removed
    std::shared_ptr<const MixedVisibility> mixed;  // null: the visibility is not MIXED
    struct Light {
        std::vector<vec3> irradiance;  // #nodes, W/m2 that links brought to each leaf
        std::vector<vec3> radiance;    // #nodes, W/(m2 sr), L of Eq. 3
        Report::Solve figures;
        std::vector<std::string> warnings;
    };
    std::shared_ptr<const Light> light;
    std::shared_ptr<const PruningTable> pruning_table;  // null: not asked for

    // As far as the stages have come.
    [[nodiscard]] const LinkSet& links() const {
        return mixed       ? mixed->links
               : lit_links ? *lit_links
               : pruned    ? pruned->links
                           : model->links;
    }
    [[nodiscard]] TransportProblem problem() const {
        return transport->problem(model->tree, links(),
                                  mixed ? mixed->row_scale : model->row_scale);
    }
};

}  // namespace antiradiance
