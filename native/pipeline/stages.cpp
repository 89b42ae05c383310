// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/stages.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>

#include "base/stopwatch.h"
#include "pipeline/choose_solver.h"
#include "prune/dark_links.h"

namespace antiradiance {

namespace {

// A render goes through the rows from the first to the last.
struct Stage {
    std::string_view name;  // in the report
    bool (*same_input)(const StageInput& was, const StageInput& is);
    void (*run)(const StageInput&, StageResults&, Report::Timings&, Progress&);
    // Figures and warnings, also when kept.
    void (*describe)(const StageInput&, const StageResults&, Report&);
    void (*forget)(StageResults&);
};

void run_model(const StageInput& input, StageResults& results, Report::Timings& timings,
               Progress& progress) {
    const Model& model = results.model.emplace(build_model(input.scene, input.options, progress));
    timings.hierarchy = model.hierarchy_seconds;
    timings.links = model.links_seconds;
    timings.visibility = model.visibility_seconds;
}

void describe_model(const StageInput& input, const StageResults& results, Report& report) {
    const Model& model = *results.model;
    for (std::size_t n = 0; n < model.tree.size(); ++n) {
        if (!model.tree.is_cluster(static_cast<NodeId>(n))) ++report.patches;
    }
    report.leaves = model.tree.leaves.size();
    for (std::size_t b = 0; b < model.cuts.per_plane.size(); ++b)
        report.blockers.per_plane.push_back(
            {input.scene.blockers[b].name, model.cuts.per_plane[b]});
    report.blockers.seconds = model.cuts.seconds;
    report.warnings.insert(report.warnings.end(), model.warnings.begin(), model.warnings.end());
}

void forget_model(StageResults& results) {
    results.model.reset();
}

void run_pruning(const StageInput& input, StageResults& results, Report::Timings&,
                 Progress& progress) {
    if (!prunes(input.options)) return;
    const Model& model = *results.model;
    progress.begin_stage("Pruning links", 0.4F, 0.45F);
    results.pruned = prune_links(
        {input.scene, model.tree, model.links, model.rays},
        {.method = input.options.pruning, .directions = input.options.pruning_directions},
        progress);
}

void describe_pruning(const StageInput& input, const StageResults& results, Report& report) {
    report.pruning.method = item_of(input.options, "pruning");
    if (results.pruned) {
        report.pruning.removed_radiance = results.pruned->removed_radiance;
        report.pruning.removed_antiradiance = results.pruned->removed_antiradiance;
        report.pruning.seconds = results.pruned->seconds;
    } else if (input.options.pruning != PruneMethod::kNone) {
        report.pruning.method = "NONE";
        report.warnings.push_back(
            "Pruning changes nothing unless Visibility is Implicit or Mixed, as there is no "
            "antiradiance: set Pruning to None, or change Visibility");
    }
}

void forget_pruning(StageResults& results) {
    results.pruned.reset();
}

void run_direct_light(const StageInput& input, StageResults& results, Report::Timings& timings,
                      Progress& progress) {
    Stopwatch watch;
    progress.begin_stage("Direct light", 0.45F, 0.6F);
    const DirectLight& direct = results.direct.emplace(input.scene, results.model->rays,
                                                       input.options.direct_light, progress);
    results.leaf_direct = direct.leaf_irradiance(results.model->tree, progress);
    timings.direct = watch.lap();
}

void describe_direct_light(const StageInput&, const StageResults& results, Report& report) {
    const DirectLight::Maps maps = results.direct->maps();
    report.direct = {maps.images, maps.bytes};
}

void forget_direct_light(StageResults& results) {
    results.direct.reset();
    results.leaf_direct = {};
}

// What the solver is given: light and reflectance of the leaves, and the links that the light
// leaves or rays decide.
void run_transport(const StageInput& input, StageResults& results, Report::Timings& timings,
                   Progress& progress) {
    const Model& model = *results.model;
    const Options& options = input.options;
    if (model.tree.size() == 0) return;
    Stopwatch watch;
    results.transport =
        make_transport_input(input.scene, model.tree, results.leaf_direct, options.direct_light);
    const bool mixed = options.visibility == Visibility::kMixed;
    if (options.remove_dark_links || mixed) progress.begin_stage("Choosing links", 0.6F, 0.65F);
    if (options.remove_dark_links) {
        const RemovedLinks dark =
            find_dark_links(model.tree, results.links(), results.transport.source,
                            results.transport.albedo, progress);
        results.lit_links = remove_links(results.links(), dark);
    }
    if (mixed) {
        results.mixed = mix_visibility(results.problem(), model.rays, model.planes,
                                       {options.ray_budget, visibility_rays(options)}, progress);
        timings.visibility += watch.lap();
    }
}

void describe_transport(const StageInput& input, const StageResults& results, Report& report) {
    const LinkSet& links = results.links();
    report.links = {links.radiance_count, links.antiradiance_count, links.links.size(),
                    links.bytes()};
    report.visibility.mode = item_of(input.options, "visibility");
    if (results.lit_links) {
        const LinkSet& before = results.pruned ? results.pruned->links : results.model->links;
        report.pruning.removed_dark = before.links.size() - results.lit_links->links.size();
    }
    if (results.mixed) {
        report.visibility.rays = results.mixed->rays;
        report.visibility.explicit_rows = results.mixed->explicit_rows;
        report.visibility.implicit_rows = results.mixed->implicit_rows;
    } else {
        const bool rays_decide = input.options.visibility == Visibility::kExplicit;
        report.visibility.rays = results.model->link_rays;
        (rays_decide ? report.visibility.explicit_rows : report.visibility.implicit_rows) =
            links.segments.size();
    }
}

void forget_transport(StageResults& results) {
    results.transport = {};
    results.lit_links.reset();
    results.mixed.reset();
}

void run_solve(const StageInput& input, StageResults& results, Report::Timings& timings,
               Progress& progress) {
    if (results.model->tree.size() == 0) {
        results.solve = {"CPU", "", "no light reaches a surface: there is nothing to solve",
                         0,     0,  true};
        return;
    }
    progress.begin_stage("Solving", 0.65F, 0.75F);
    const Options& options = input.options;
    SolveOptions solve;
    solve.iterations = options.iterations;
    SolverRun run = solve_transport(options.solver, results.problem(), solve, progress);
    Solution& solution = run.solution;
    if (!run.device.warning.empty()) results.solve_warnings.push_back(run.device.warning);
    if (!solution.converged && options.iterations == 0) {
        results.solve_warnings.push_back("The solution did not converge (residual " +
                                         std::to_string(solution.residual) +
                                         "): lower Direction Bins, or set Visibility to Explicit");
    }
    results.solve = {solution.backend,
                     solution.renderer,
                     run.device.reason,
                     solution.iterations,
                     static_cast<double>(solution.residual),
                     solution.converged};
    results.irradiance = std::move(solution.irradiance);
    results.radiance = std::move(solution.radiance);
    timings.solve = solution.seconds;
}

void describe_solve(const StageInput&, const StageResults& results, Report& report) {
    report.solve = results.solve;
    report.warnings.insert(report.warnings.end(), results.solve_warnings.begin(),
                           results.solve_warnings.end());
}

void forget_solve(StageResults& results) {
    results.irradiance = {};
    results.radiance = {};
    results.solve = {};
    results.solve_warnings = {};
}

// Apart from the solution that is shown: the rules are for links with antiradiance, whatever it
// has.
void run_evaluation(const StageInput& input, StageResults& results, Report::Timings&,
                    Progress& progress) {
    if (!input.options.evaluate_pruning) return;
    progress.begin_stage("Evaluating pruning", 0.75F, 0.8F);
    results.pruning_table =
        input.options.has_antiradiance()
            ? evaluate_rules(input.scene, input.options, *results.model, {}, progress)
            : evaluate_rules(input.scene, input.options, {}, progress);
}

void describe_evaluation(const StageInput&, const StageResults& results, Report& report) {
    report.pruning.table = results.pruning_table;
}

void forget_evaluation(StageResults& results) {
    results.pruning_table = {};
}

// A picture goes to whoever asked for it and is made anew each time.
bool never_same(const StageInput&, const StageInput&) {
    return false;
}

void run_display(const StageInput& input, StageResults& results, Report::Timings& timings,
                 Progress& progress) {
    if (!input.scene.has_camera) return;
    Stopwatch watch;
    progress.begin_stage("Display", 0.75F, 1);
    results.shown = results.display.make_picture(
        input.options.solver,
        {input.scene, results.model->rays, results.model->planes, results.model->tree,
         results.links(), results.pruned ? &results.pruned->links : nullptr, *results.direct,
         results.leaf_direct, results.irradiance, results.radiance, input.film_transparent},
        input.options.resolved_display(), progress);
    timings.display = watch.lap();
}

void describe_display(const StageInput& input, const StageResults& results, Report& report) {
    const DisplayRun& run = results.shown;
    report.display = {std::string(item_of(input.options, "display")), run.backend, run.renderer};
    if (!run.device.warning.empty()) report.warnings.push_back(run.device.warning);
}

void forget_display(StageResults& results) {
    results.shown = {};
}

constexpr std::array kStages{
    Stage{"model", same_model_input, run_model, describe_model, forget_model},
    Stage{"pruning", same_pruning_input, run_pruning, describe_pruning, forget_pruning},
    Stage{"direct_light", same_direct_light_input, run_direct_light, describe_direct_light,
          forget_direct_light},
    Stage{"transport", same_transport_input, run_transport, describe_transport, forget_transport},
    Stage{"solve", same_solve_input, run_solve, describe_solve, forget_solve},
    Stage{"evaluation", same_evaluation_input, run_evaluation, describe_evaluation,
          forget_evaluation},
    Stage{"display", never_same, run_display, describe_display, forget_display},
};

}  // namespace

void Stages::forget_changed(const StageInput& input) {
    const auto done = std::span(kStages).first(done_);
    const auto changed = std::ranges::find_if_not(
        done, [&](const Stage& stage) { return stage.same_input(input_, input); });
    done_ = static_cast<std::size_t>(changed - done.begin());
    // Later ones borrow from earlier ones. The one after the done ones may have failed half way.
    for (std::size_t i = kStages.size(); i-- > done_;)
        kStages[i].forget(results_);
}

Picture Stages::run(StageInput input, Progress& progress, Report& report) {
    forget_changed(input);
    input_ = std::move(input);
    for (std::size_t i = 0; i < kStages.size(); ++i) {
        const bool kept = i < done_;
        report.stages.push_back({std::string(kStages[i].name), kept ? "kept" : "run"});
        if (!kept) {
            kStages[i].run(input_, results_, report.timings_s, progress);
            done_ = i + 1;
        }
        kStages[i].describe(input_, results_, report);
    }
    return std::move(results_.shown.picture);
}

}  // namespace antiradiance
