// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/session.h"

#include <exception>
#include <fstream>
#include <utility>

#include "base/error.h"
#include "base/memory.h"
#include "base/stopwatch.h"
#include "pipeline/check_scene.h"
#include "pipeline/show.h"
#include "pipeline/stages.h"

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

}  // namespace

struct Session::Impl {
    Stages stages;
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
        progress.begin_stage("Checking the scene", 0, 0.02F);
        report.warnings = check_scene(scene);
        const SolvedScene solved =
            impl_->stages.run({std::move(scene), options, film_transparent}, progress, report);
        report.stages.push_back({"display", "run"});
        report.display.mode = item_of(options, "display");
        if (solved.input->scene.has_camera) {
            Stopwatch watch;
            progress.begin_stage("Display", 0.75F, 1);
            DisplayRun run = show(solved, solved.input->scene.camera, options.resolved_display(),
                                  {}, impl_->display, progress);
            report.timings_s.display = watch.lap();
            report.display.backend = run.backend;
            report.display.renderer = run.renderer;
            if (!run.device.warning.empty()) report.warnings.push_back(run.device.warning);
            result.picture = std::move(run.picture);
        }
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
