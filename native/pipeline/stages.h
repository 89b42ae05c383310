// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of a render: a chain, each of which reads what those before it made. What they made is
// kept, and a stage is run again only when its input has changed or one before it has run: a camera
// that moves solves nothing again.
//
// A new stage is a row of the table in stages.cpp; what it reads is listed in stage_input.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "display/display.h"
#include "pipeline/choose_display.h"
#include "pipeline/evaluate_rules.h"
#include "pipeline/model.h"
#include "pipeline/report.h"
#include "pipeline/stage_input.h"
#include "pipeline/transport_input.h"
#include "prune/prune.h"
#include "solve/direct_light.h"
#include "solve/mixed_visibility.h"

namespace antiradiance {

struct StageResults {
    std::optional<Model> model;
    std::optional<PruneResult> pruned;  // without: all of the model's links take part
    std::optional<DirectLight> direct;
    std::vector<vec3> leaf_direct;  // #nodes, W/m2 of it on each leaf
    TransportInput transport;
    std::optional<LinkSet> lit_links;      // without: no dark links were removed
    std::optional<MixedVisibility> mixed;  // without: the visibility is not MIXED
    std::vector<vec3> irradiance;          // #nodes, W/m2 that links brought to each leaf
    std::vector<vec3> radiance;            // #nodes, W/(m2 sr), L of Eq. 3
    Report::Solve solve;
    std::vector<std::string> solve_warnings;
    PruningTable pruning_table;  // empty: not asked for
    ChosenDisplay display;       // for its compiled shaders
    DisplayRun shown;            // empty without a camera

    // As far as the stages have come.
    [[nodiscard]] const LinkSet& links() const {
        return mixed       ? mixed->links
               : lit_links ? *lit_links
               : pruned    ? pruned->links
                           : model->links;
    }
    [[nodiscard]] TransportProblem problem() const {
        return transport.problem(model->tree, links(), mixed ? mixed->row_scale : model->row_scale);
    }
};

class Stages {
public:
    // Runs what `input` asks for. What a stage before had made of older input is freed first.
    // Writes each stage's figures, warnings and whether it ran into `report`, as far as it gets.
    // Throws what the stages throw; those that were done by then are kept.
    Picture run(StageInput input, Progress& progress, Report& report);

private:
    void forget_changed(const StageInput& input);

    StageInput input_;  // of the last run
    StageResults results_;
    std::size_t done_ = 0;  // stages whose results fit input_
};

}  // namespace antiradiance
