// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/live_solver.h"

#include <chrono>
#include <utility>

#include "base/error.h"
#include "base/stopwatch.h"
#include "pipeline/check_scene.h"

namespace antiradiance {

namespace {

// A solution that takes longer than this is preceded by a coarse one.
constexpr double kSoon = 0.25;  // s
// Of quick work that turns out not to be, until a newer edit may cancel it.
constexpr std::chrono::seconds kPatience{5};
// The office's EXPLICIT solution then has a twelfth of the links and takes a seventh of the time.
constexpr float kCoarseness = 3;

StageInput without_reports(StageInput input) {
    input.options.report_path.clear();
    input.options.evaluate_pruning = false;
    return input;
}

// With links between clusters, which only EXPLICIT has, and none pruned.
StageInput coarse_input(StageInput input) {
    input.coarseness = kCoarseness;
    input.options.visibility = Visibility::kExplicit;
    input.options.visibility_rays = 1;
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
        if (running_ && !same_solution_input(*running_for_, *edit) && !is_shielded())
            running_->cancel();
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

bool LiveSolver::is_shielded() const {
    return std::chrono::steady_clock::now() < shielded_until_;
}

// What comes next is quick: it is finished though another edit waits, or one that is dragged would
// show nothing until it rests.
void LiveSolver::shield() {
    const std::scoped_lock lock(mutex_);
    shielded_until_ = std::chrono::steady_clock::now() + kPatience;
}

// What comes next takes its time. Throws Cancelled when an edit waits that it does not solve for.
void LiveSolver::unshield() {
    const std::scoped_lock lock(mutex_);
    shielded_until_ = {};
    if (waiting_ && !same_solution_input(*running_for_, *waiting_->input)) throw Cancelled();
}

LiveSolver::State LiveSolver::state() const {
    const std::scoped_lock lock(mutex_);
    return state_;
}

std::shared_ptr<const LiveSolver::Solution> LiveSolver::newest() const {
    const std::scoped_lock lock(mutex_);
    return newest_;
}

std::shared_ptr<const LiveSolver::Solution> LiveSolver::newest_whole() const {
    const std::scoped_lock lock(mutex_);
    return newest_whole_;
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
    shield();
    if (whole_.expected_seconds(input) > kSoon) {
        if (!solve_relit(input, edit, warnings, progress))
            last_coarse_ =
                solve_with(coarse_, coarse_input(input), last_coarse_ ? &*last_coarse_ : nullptr,
                           edit, warnings, progress);
        unshield();
    }
    const auto whole = newest_whole();
    solve_with(whole_, std::move(input), whole ? &whole->scene : nullptr, edit, warnings, progress);
}

bool LiveSolver::solve_relit(const StageInput& input, const Edit& edit,
                             const std::vector<std::string>& warnings, Progress& progress) {
    Stopwatch watch;
    Report report = report_of(edit, warnings);
    std::optional<SolvedScene> relit = whole_.run_relit(input, progress, report);
    if (relit) publish(std::move(*relit), std::move(report), watch.lap(), true);
    return relit.has_value();
}

SolvedScene LiveSolver::solve_with(Stages& stages, StageInput input, const SolvedScene* earlier,
                                   const Edit& edit, const std::vector<std::string>& warnings,
                                   Progress& progress) {
    Stopwatch watch;
    const bool preliminary = input.coarseness > 1;
    Report report = report_of(edit, warnings);
    SolvedScene solved =
        stages.run(std::move(input), progress, report, {.keep = true, .earlier = earlier});
    publish(solved, std::move(report), watch.lap(), preliminary);
    return solved;
}

Report LiveSolver::report_of(const Edit& edit, const std::vector<std::string>& warnings) {
    Report report;
    report.warnings = warnings;
    report.timings_s.sync = edit.sync_seconds;
    return report;
}

void LiveSolver::publish(SolvedScene solved, Report report, double seconds, bool preliminary) {
    report.timings_s.total = report.timings_s.sync + seconds;
    std::string json = report.to_json();
    {
        const std::scoped_lock lock(mutex_);
        newest_ = std::make_shared<const Solution>(Solution{newest_ ? newest_->number + 1 : 1,
                                                            preliminary, std::move(solved),
                                                            std::move(report), std::move(json)});
        if (!preliminary) newest_whole_ = newest_;
        state_.error.clear();
    }
    bell_.ring();
}

}  // namespace antiradiance
