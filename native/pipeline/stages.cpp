// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/stages.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <span>
#include <string_view>
#include <utility>

#include "base/stopwatch.h"
#include "pipeline/choose_solver.h"
#include "pipeline/relight.h"
#include "prune/dark_links.h"

namespace antiradiance {

namespace {

// A run goes through the rows from the first to the last.
struct Stage {
    std::string_view name;  // in the report
    bool (*same_input)(const StageInput& was, const StageInput& is);
    void (*run)(const StageInput&, const Stages::Reuse&, SolvedScene&, Report::Timings&, Progress&);
    // Figures and warnings, also when kept.
    void (*describe)(const StageInput&, const SolvedScene&, Report&);
    void (*forget)(SolvedScene&);
};

void run_model(const StageInput& input, const Stages::Reuse& reuse, SolvedScene& solved,
               Report::Timings& timings, Progress& progress) {
    ModelReuse of_model{.keep = reuse.keep};
    if (reuse.earlier) {
        of_model.scene = &reuse.earlier->input->scene;
        of_model.model = reuse.earlier->model.get();
    }
    solved.model = std::make_shared<Model>(
        build_model(input.scene, input.options, progress, input.coarseness, of_model));
    const Model& model = *solved.model;
    timings.hierarchy = model.hierarchy_seconds;
    timings.links = model.links_seconds;
    timings.visibility = model.visibility_seconds;
}

void describe_model(const StageInput& input, const SolvedScene& solved, Report& report) {
    const Model& model = *solved.model;
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

void forget_model(SolvedScene& solved) {
    solved.model.reset();
}

void run_pruning(const StageInput& input, const Stages::Reuse&, SolvedScene& solved,
                 Report::Timings&, Progress& progress) {
    if (!prunes(input.options)) return;
    const Model& model = *solved.model;
    progress.begin_stage("Pruning links", 0.4F, 0.45F);
    solved.pruned = std::make_shared<PruneResult>(prune_links(
        {input.scene, model.tree, model.links, model.rays},
        {.method = input.options.pruning, .directions = input.options.pruning_directions},
        progress));
}

void describe_pruning(const StageInput& input, const SolvedScene& solved, Report& report) {
    report.pruning.method = item_of(input.options, "pruning");
    if (solved.pruned) {
        report.pruning.removed_radiance = solved.pruned->removed_radiance;
        report.pruning.removed_antiradiance = solved.pruned->removed_antiradiance;
        report.pruning.seconds = solved.pruned->seconds;
    } else if (input.options.pruning != PruneMethod::kNone) {
        report.pruning.method = "NONE";
        report.warnings.push_back(
            "Pruning changes nothing unless Visibility is Implicit or Mixed, as there is no "
            "antiradiance: set Pruning to None, or change Visibility");
    }
}

void forget_pruning(SolvedScene& solved) {
    solved.pruned.reset();
}

void run_direct_light(const StageInput& input, const Stages::Reuse& reuse, SolvedScene& solved,
                      Report::Timings& timings, Progress& progress) {
    Stopwatch watch;
    progress.begin_stage("Direct light", 0.45F, 0.6F);
    solved.direct = std::make_shared<DirectLight>(input.scene, solved.model->rays,
                                                  input.options.direct_light, progress);
    const auto shares = std::make_shared<LightShares>();
    const float tolerance = input.coarseness * input.coarseness * DirectLight::kLeafTolerance;
    const auto light_leaves = [&](const EarlierLight* earlier) {
        solved.leaf_direct = std::make_shared<std::vector<vec3>>(solved.direct->leaf_irradiance(
            solved.model->tree, progress, shares.get(), tolerance, earlier));
    };
    if (const SolvedScene* was = reuse.earlier; was && same_lights(*was->input, input)) {
        const SceneChange change(was->input->scene, was->model->tree, input.scene,
                                 solved.model->tree);
        const EarlierLight earlier{change, was->model->tree, *was->leaf_direct, *was->light_shares};
        light_leaves(&earlier);
    } else {
        light_leaves(nullptr);
    }
    solved.light_shares = shares;
    timings.direct = watch.lap();
}

void describe_direct_light(const StageInput&, const SolvedScene& solved, Report& report) {
    const DirectLight::Maps maps = solved.direct->maps();
    report.direct = {maps.images, maps.bytes};
}

void forget_direct_light(SolvedScene& solved) {
    solved.direct.reset();
    solved.leaf_direct.reset();
    solved.light_shares.reset();
}

// What the solver is given: light and reflectance of the leaves, and the links that the light
// leaves or rays decide.
void run_transport(const StageInput& input, const Stages::Reuse&, SolvedScene& solved,
                   Report::Timings& timings, Progress& progress) {
    const Model& model = *solved.model;
    const Options& options = input.options;
    Stopwatch watch;
    solved.transport = std::make_shared<TransportInput>(
        make_transport_input(input.scene, model.tree, *solved.leaf_direct, options.direct_light));
    if (model.tree.size() == 0) return;
    const bool mixed = options.visibility == Visibility::kMixed;
    if (options.remove_dark_links || mixed) progress.begin_stage("Choosing links", 0.6F, 0.65F);
    if (options.remove_dark_links) {
        const RemovedLinks dark =
            find_dark_links(model.tree, solved.links(), solved.transport->source,
                            solved.transport->albedo, progress);
        solved.lit_links = std::make_shared<LinkSet>(remove_links(solved.links(), dark));
    }
    if (mixed) {
        solved.mixed = std::make_shared<MixedVisibility>(
            mix_visibility(solved.problem(), model.rays, model.planes,
                           {options.ray_budget, visibility_rays(options)}, progress));
        timings.visibility += watch.lap();
    }
}

void describe_transport(const StageInput& input, const SolvedScene& solved, Report& report) {
    const LinkSet& links = solved.links();
    report.links = {links.radiance_count, links.antiradiance_count, links.links.size(),
                    links.bytes()};
    report.visibility.mode = item_of(input.options, "visibility");
    if (solved.lit_links) {
        const LinkSet& before = solved.pruned ? solved.pruned->links : solved.model->links;
        report.pruning.removed_dark = before.links.size() - solved.lit_links->links.size();
    }
    if (solved.mixed) {
        report.visibility.rays = solved.mixed->rays;
        report.visibility.explicit_rows = solved.mixed->explicit_rows;
        report.visibility.implicit_rows = solved.mixed->implicit_rows;
    } else {
        const bool rays_decide = input.options.visibility == Visibility::kExplicit;
        report.visibility.rays = solved.model->link_rays;
        (rays_decide ? report.visibility.explicit_rows : report.visibility.implicit_rows) =
            links.segments.size();
    }
}

void forget_transport(SolvedScene& solved) {
    solved.transport.reset();
    solved.lit_links.reset();
    solved.mixed.reset();
}

void run_solve(const StageInput& input, const Stages::Reuse&, SolvedScene& solved,
               Report::Timings& timings, Progress& progress) {
    auto light = std::make_shared<SolvedScene::Light>();
    if (solved.model->tree.size() == 0) {
        light->figures = {"CPU", "", "no light reaches a surface: there is nothing to solve",
                          0,     0,  true};
        solved.light = std::move(light);
        return;
    }
    progress.begin_stage("Solving", 0.65F, 0.75F);
    const Options& options = input.options;
    SolveOptions solve;
    solve.iterations = options.iterations;
    SolverRun run = solve_transport(options.solver, solved.problem(), solve, progress);
    Solution& solution = run.solution;
    if (!run.device.warning.empty()) light->warnings.push_back(run.device.warning);
    if (!solution.converged && options.iterations == 0) {
        light->warnings.push_back("The solution did not converge (residual " +
                                  std::to_string(solution.residual) +
                                  "): lower Direction Bins, or set Visibility to Explicit");
    }
    light->figures = {solution.backend,
                      solution.renderer,
                      run.device.reason,
                      solution.iterations,
                      static_cast<double>(solution.residual),
                      solution.converged};
    light->irradiance = std::move(solution.irradiance);
    light->radiance = std::move(solution.radiance);
    solved.light = std::move(light);
    timings.solve = solution.seconds;
}

void describe_solve(const StageInput&, const SolvedScene& solved, Report& report) {
    report.solve = solved.light->figures;
    report.warnings.insert(report.warnings.end(), solved.light->warnings.begin(),
                           solved.light->warnings.end());
}

void forget_solve(SolvedScene& solved) {
    solved.light.reset();
}

// Apart from the solution that is shown: the rules are for links with antiradiance, whatever it
// has.
void run_evaluation(const StageInput& input, const Stages::Reuse&, SolvedScene& solved,
                    Report::Timings&, Progress& progress) {
    if (!input.options.evaluate_pruning) return;
    progress.begin_stage("Evaluating pruning", 0.75F, 0.8F);
    solved.pruning_table = std::make_shared<PruningTable>(
        input.options.has_antiradiance()
            ? evaluate_rules(input.scene, input.options, *solved.model, {}, progress)
            : evaluate_rules(input.scene, input.options, {}, progress));
}

void describe_evaluation(const StageInput&, const SolvedScene& solved, Report& report) {
    if (solved.pruning_table) report.pruning.table = *solved.pruning_table;
}

void forget_evaluation(SolvedScene& solved) {
    solved.pruning_table.reset();
}

constexpr std::array<Stage, Stages::kCount> kStages{{
    {"model", same_model_input, run_model, describe_model, forget_model},
    {"pruning", same_pruning_input, run_pruning, describe_pruning, forget_pruning},
    {"direct_light", same_direct_light_input, run_direct_light, describe_direct_light,
     forget_direct_light},
    {"transport", same_transport_input, run_transport, describe_transport, forget_transport},
    {"solve", same_solve_input, run_solve, describe_solve, forget_solve},
    {"evaluation", same_evaluation_input, run_evaluation, describe_evaluation, forget_evaluation},
}};

}  // namespace

Stages::Stages() {
    seconds_.fill(std::numeric_limits<double>::infinity());
}

std::size_t Stages::first_changed(const StageInput& input) const {
    const auto done = std::span(kStages).first(done_);
    const auto changed = std::ranges::find_if_not(
        done, [&](const Stage& stage) { return stage.same_input(*solved_.input, input); });
    return static_cast<std::size_t>(changed - done.begin());
}

double Stages::expected_seconds(const StageInput& input) const {
    const auto to_run = std::span(seconds_).subspan(first_changed(input));
    return std::accumulate(to_run.begin(), to_run.end(), 0.0);
}

SolvedScene Stages::run(StageInput input, Progress& progress, Report& report, const Reuse& reuse) {
    done_ = first_changed(input);
    // Later ones borrow from earlier ones. The one after the done ones may have failed half way.
    for (std::size_t i = kStages.size(); i-- > done_;)
        kStages[i].forget(solved_);
    solved_.input = std::make_shared<const StageInput>(std::move(input));
    for (std::size_t i = 0; i < kStages.size(); ++i) {
        const bool kept = i < done_;
        report.stages.push_back({std::string(kStages[i].name), kept ? "kept" : "run"});
        if (!kept) {
            Stopwatch watch;
            kStages[i].run(*solved_.input, reuse, solved_, report.timings_s, progress);
            seconds_[i] = watch.lap();
            done_ = i + 1;
        }
        kStages[i].describe(*solved_.input, solved_, report);
    }
    return solved_;
}

std::optional<SolvedScene> Stages::run_relit(StageInput input, Progress& progress,
                                             Report& report) const {
    constexpr std::size_t kFirst = 3;  // the stage after direct light
    static_assert(kStages[kFirst - 1].name == "direct_light");
    if (done_ < kFirst) return std::nullopt;
    std::optional<std::vector<vec3>> direct = relight(solved_, input);
    if (!direct) return std::nullopt;
    SolvedScene relit = solved_;
    relit.input = std::make_shared<const StageInput>(std::move(input));
    relit.leaf_direct = std::make_shared<std::vector<vec3>>(std::move(*direct));
    for (std::size_t i = 0; i < kStages.size(); ++i) {
        report.stages.push_back({std::string(kStages[i].name), i < kFirst ? "kept" : "run"});
        if (i >= kFirst) {
            kStages[i].forget(relit);
            kStages[i].run(*relit.input, {}, relit, report.timings_s, progress);
        }
        kStages[i].describe(*relit.input, relit, report);
    }
    return relit;
}

}  // namespace antiradiance
