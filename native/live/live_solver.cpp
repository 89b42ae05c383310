// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/live_solver.h"

#include <utility>

#include "base/error.h"
#include "base/stopwatch.h"
#include "pipeline/check_scene.h"

namespace antiradiance {

namespace {

// A solution that takes longer than this is preceded by a coarse one.
constexpr double kSoon = 0.25;  // s
// In the office with visibility EXPLICIT, 3 makes a tenth of the links in a seventh of the time.
constexpr float kCoarseness = 3;

StageInput without_reports(StageInput input) {
    input.options.report_path.clear();
    input.options.evaluate_pruning = false;
    return input;
}

}  // namespace

LiveSolver::LiveSolver() : thread_([this] { serve(); }) {}

void LiveSolver::stop() {
    {
        const std::scoped_lock lock(mutex_);
        stop_ = true;
        if (running_) running_->cancel();
    }
    bell_.ring();
    if (thread_.joinable()) thread_.join();
}

void LiveSolver::post(StageInput input, double sync_seconds) {
    const auto edit = std::make_shared<const StageInput>(without_reports(std::move(input)));
    {
        const std::scoped_lock lock(mutex_);
        if (last_posted_ && same_solution_input(*last_posted_, *edit) &&
            same_picture_input(*last_posted_, *edit))
            return;
        last_posted_ = edit;
        waiting_ = Edit{edit, sync_seconds};
        state_.working = true;
        ++state_.edits;
        if (running_ && !same_solution_input(*running_for_, *edit)) running_->cancel();
    }
    bell_.ring();
}

void LiveSolver::pause(bool paused) {
    {
        const std::scoped_lock lock(mutex_);
        if (state_.paused == paused) return;
        state_.paused = paused;
    }
    paused ? gate_.hold() : gate_.release();
    bell_.ring();
}

LiveSolver::State LiveSolver::state() const {
    const std::scoped_lock lock(mutex_);
    return state_;
}

std::shared_ptr<const LiveSolver::Solution> LiveSolver::newest() const {
    const std::scoped_lock lock(mutex_);
    return newest_;
}

void LiveSolver::serve() {
    while (true) {
        const std::uint64_t heard = bell_.rings();
        Progress progress(
            [this](float fraction, const std::string& stage) {
                const std::scoped_lock lock(mutex_);
                state_.fraction = fraction;
                state_.stage = stage;
            },
            {}, &gate_);
        std::optional<Edit> edit;
        {
            const std::scoped_lock lock(mutex_);
            if (stop_) return;
            edit = std::exchange(waiting_, std::nullopt);
            if (edit) {
                running_for_ = edit->input;
                running_ = &progress;
            }
        }
        if (!edit) {
            bell_.wait(heard);
            continue;
        }
        try {
            solve(*edit, progress);
            finish("");
        } catch (const Cancelled&) {
            finish("");
        } catch (const std::exception& failure) {
            finish(failure.what());
        }
    }
}

void LiveSolver::finish(const std::string& error) {
    {
        const std::scoped_lock lock(mutex_);
        running_ = nullptr;
        running_for_.reset();
        state_.working = waiting_.has_value();
        state_.stage.clear();
        state_.fraction = 0;
        // An edit that waits may have cured it.
        if (!waiting_) state_.error = error;
    }
    bell_.ring();
}

void LiveSolver::solve(const Edit& edit, Progress& progress) {
    StageInput input = *edit.input;
    progress.begin_stage("Checking the scene", 0, 0.02F);
    const std::vector<std::string> warnings = check_scene(input.scene);
    if (whole_.expected_seconds(input) > kSoon && !solve_relit(input, edit, warnings, progress)) {
        StageInput coarse = input;
        coarse.coarseness = kCoarseness;
        solve_with(coarse_, std::move(coarse), edit, warnings, progress);
    }
    solve_with(whole_, std::move(input), edit, warnings, progress);
}

bool LiveSolver::solve_relit(const StageInput& input, const Edit& edit,
                             const std::vector<std::string>& warnings, Progress& progress) {
    Stopwatch watch;
    Report report = report_of(edit, warnings);
    std::optional<SolvedScene> relit = whole_.run_relit(input, progress, report);
    if (relit) publish(std::move(*relit), std::move(report), watch.lap(), true);
    return relit.has_value();
}

void LiveSolver::solve_with(Stages& stages, StageInput input, const Edit& edit,
                            const std::vector<std::string>& warnings, Progress& progress) {
    Stopwatch watch;
    const bool preliminary = input.coarseness > 1;
    Report report = report_of(edit, warnings);
    SolvedScene solved = stages.run(std::move(input), progress, report);
    publish(std::move(solved), std::move(report), watch.lap(), preliminary);
}

Report LiveSolver::report_of(const Edit& edit, const std::vector<std::string>& warnings) {
    Report report;
    report.warnings = warnings;
    report.timings_s.sync = edit.sync_seconds;
    return report;
}

void LiveSolver::publish(SolvedScene solved, Report report, double seconds, bool preliminary) {
    report.timings_s.total = report.timings_s.sync + seconds;
    {
        const std::scoped_lock lock(mutex_);
        newest_ = std::make_shared<const Solution>(Solution{
            newest_ ? newest_->number + 1 : 1, preliminary, std::move(solved), std::move(report)});
        state_.error.clear();
    }
    bell_.ring();
}

}  // namespace antiradiance
