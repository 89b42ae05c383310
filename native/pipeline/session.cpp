// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/session.h"

#include <exception>
#include <fstream>

#include "base/error.h"
#include "base/memory.h"
#include "pipeline/choose_display.h"
#include "pipeline/choose_solver.h"
#include "pipeline/model.h"
#include "pipeline/stopwatch.h"
#include "pipeline/transport_input.h"
#include "scene/validate.h"

namespace antiradiance {

namespace {

// Opened before the work starts: a path that can't be written is told at once.
class ReportFile {
public:
    explicit ReportFile(const std::string& path) : path_(path) {
        if (path.empty()) return;
        file_.open(path);
        if (!file_) {
            throw SceneError("The report can't be written to '" + path +
                             "': check the folder and its permissions in Report");
        }
    }
    void write(const Report& report) {
        if (path_.empty()) return;
        file_ << report.to_json() << '\n';
        file_.flush();
        if (!file_) throw std::runtime_error("The report could not be written to '" + path_ + "'");
    }

private:
    std::string path_;
    std::ofstream file_;
};

void describe(const Model& model, Report& report) {
    for (std::size_t n = 0; n < model.tree.size(); ++n) {
        if (!model.tree.is_cluster(static_cast<NodeId>(n))) ++report.patches;
    }
    report.leaves = model.tree.leaves.size();
    report.links.radiance = model.links.radiance_count;
    report.links.antiradiance = model.links.antiradiance_count;
    report.links.total = model.links.links.size();
    report.links.bytes = model.links.bytes();
    report.timings_s.hierarchy = model.hierarchy_seconds;
    report.timings_s.links = model.links_seconds;
    report.timings_s.visibility = model.visibility_seconds;
    report.warnings.insert(report.warnings.end(), model.warnings.begin(), model.warnings.end());
}

bool has_light(const Scene& scene) {
    for (const Lamp& lamp : scene.lamps) {
        if (max_component(lamp.power) > 0) return true;
    }
    for (const std::int32_t m : scene.triangle_material) {
        if (scene.materials[static_cast<std::size_t>(m)].emits()) return true;
    }
    return false;
}

Picture render_stages(Scene& scene, const Options& options, bool film_transparent,
                      ChosenDisplay& display, Progress& progress, Report& report) {
    progress.begin_stage("Checking the scene", 0, 0.02F);
    report.warnings = validate(scene);
    if (!has_light(scene)) {
        report.warnings.emplace_back(
            "The scene has no light: add a lamp or a material with emission; the picture is black");
    }
    const Model model = build_model(scene, options, progress);
    describe(model, report);

    Stopwatch watch;
    progress.begin_stage("Direct light", 0.45F, 0.6F);
    const DirectLight direct(scene, model.rays, options.direct_light, progress);
    report.direct = {direct.maps().images, direct.maps().bytes};
    const std::vector<vec3> leaf_direct = direct.leaf_irradiance(model.tree, progress);
    report.timings_s.direct = watch.lap();

    std::vector<vec3> irradiance(model.tree.size(), vec3(0));
    std::vector<vec3> radiance(model.tree.size(), vec3(0));
    if (model.tree.size() > 0) {
        progress.begin_stage("Solving", 0.6F, 0.75F);
        const TransportInput input =
            make_transport_input(model.tree, leaf_direct, options.direct_light);
        SolveOptions solve;
        solve.iterations = options.iterations;
        SolverRun run = solve_transport(options.solver, input.problem(model), solve, progress);
        Solution& solution = run.solution;
        if (!run.device.warning.empty()) report.warnings.push_back(run.device.warning);
        report.solve = {solution.backend,
                        solution.renderer,
                        run.device.reason,
                        solution.iterations,
                        static_cast<double>(solution.residual),
                        solution.converged};
        if (!solution.converged && options.iterations == 0) {
            report.warnings.push_back("The solution did not converge (residual " +
                                      std::to_string(solution.residual) +
                                      "): lower Direction Bins, or set Visibility to Explicit");
        }
        report.timings_s.solve = solution.seconds;
        irradiance = std::move(solution.irradiance);
        radiance = std::move(solution.radiance);
    } else {
        report.solve = {"CPU", "", "no light reaches a surface: there is nothing to solve",
                        0,     0,  true};
    }

    watch.lap();
    progress.begin_stage("Display", 0.75F, 1);
    DisplayRun run;
    if (scene.has_camera) {
        run = display.make_picture(options.solver,
                                   {scene, model.rays, model.tree, model.links, false, direct,
                                    leaf_direct, irradiance, radiance, film_transparent},
                                   options.resolved_display(), progress);
        if (!run.device.warning.empty()) report.warnings.push_back(run.device.warning);
    }
    report.display = {std::string(item_of(options, "display")), run.backend, run.renderer};
    report.timings_s.display = watch.lap();
    return std::move(run.picture);
}

}  // namespace

struct Session::Impl {
    ChosenDisplay display;
};

Session::Session() : impl_(std::make_unique<Impl>()) {}
Session::~Session() = default;

RenderResult Session::render(Scene scene, const Options& options, bool film_transparent,
                             double sync_seconds, Progress& progress) {
    RenderResult result;
    Report& report = result.report;
    Stopwatch total;
    report.timings_s.sync = sync_seconds;
    ReportFile file(options.report_path);
    const auto finish = [&](const std::string& error) {
        report.error = error;
        report.timings_s.total = sync_seconds + total.lap();
        report.peak_memory_bytes = peak_memory_bytes();
        file.write(report);
    };
    try {
        result.picture =
            render_stages(scene, options, film_transparent, impl_->display, progress, report);
    } catch (const std::exception& e) {
        finish(e.what());
        throw;
    }
    finish("");
    return result;
}

void write_failure_report(const std::string& path, const std::string& error,
                          const std::vector<std::string>& warnings, double sync_seconds) {
    Report report;
    report.error = error;
    report.warnings = warnings;
    report.timings_s.sync = sync_seconds;
    report.timings_s.total = sync_seconds;
    report.peak_memory_bytes = peak_memory_bytes();
    ReportFile(path).write(report);
}

}  // namespace antiradiance
