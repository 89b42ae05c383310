// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's Tables 1 and 2 for a scene, and what they leave out: what pruning does to the light.
#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "pipeline/model.h"
#include "pipeline/options.h"
#include "pipeline/solution_error.h"
#include "prune/evaluate.h"
#include "scene/scene.h"

namespace antiradiance {

struct RuleEvaluation {
    std::string method;  // the rule's identifier
    PruneEvaluation counts;
    SolutionError error;  // of the solution over the links that are left
};

struct PruningTable {
    std::size_t patches = 0;        // leaves
    std::size_t links = 0;          // + and -
    std::size_t explicit_test = 0;  // links that no ray gets through
    double explicit_seconds = 0;    // what testing all links with rays took
    SolutionError unpruned;
    std::vector<RuleEvaluation> rules;  // all that trace no rays themselves
};

struct EvaluationRays {
    int truth = 64;      // a link, for "explicit test"
    int reference = 16;  // a + link, for the solution that errors are measured by
};

// Solves the scene with IMPLICIT visibility over all links and over what each rule leaves of them.
// Options::visibility and pruning are not read. `scene` is valid, `implicit` made of it with
// antiradiance. Throws as Session::render() does.
[[nodiscard]] PruningTable evaluate_rules(const Scene& scene, const Options& options,
                                          const Model& implicit, const EvaluationRays& rays,
                                          Progress& progress);
// Builds the model first; `scene` is validated (and cleaned) before.
[[nodiscard]] PruningTable evaluate_rules(Scene scene, Options options, const EvaluationRays& rays,
                                          Progress& progress);

}  // namespace antiradiance
