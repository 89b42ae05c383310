// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps the solution of a scene that is being edited up to date, on a thread of its own.
//
//   LiveSolver solver;
//   solver.post(input);            // each edit: returns at once
//   auto now = solver.newest();    // a coarse solution soon, the whole one after it
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/pause_gate.h"
#include "base/progress.h"
#include "live/bell.h"
#include "pipeline/report.h"
#include "pipeline/solved_scene.h"
#include "pipeline/stages.h"

namespace antiradiance {

class LiveSolver {
public:
    struct Solution {
        std::uint64_t number = 0;  // 1, 2, ...
        // The whole one follows: this one is of coarser patches, or of direct light that was scaled
        // with its lights.
        bool preliminary = false;
        SolvedScene scene;
        Report report;
        std::string report_json;
    };
    struct State {
        bool working = false;  // there are edits without their whole solution
        bool paused = false;
        std::string stage;   // of the running work
        float fraction = 0;  // of it, 0..1
        std::string error;   // why the newest edit has no solution; empty: it has or will have
        std::uint64_t edits = 0;
    };

    LiveSolver();
    ~LiveSolver() { stop(); }
    LiveSolver(const LiveSolver&) = delete;
    LiveSolver& operator=(const LiveSolver&) = delete;

    // The newest edit, which replaces any that waits. Running work is cancelled unless it solves
    // for the same or is about to end; nothing happens when no picture would differ. What is wrong
    // with the scene shows in state(). The options' report and evaluation of pruning are left out.
    // From any thread.
    void post(StageInput input, double sync_seconds = 0);

    // Cancels the work and waits for its end, some 50 ms. Edits are then left alone.
    void stop();

    // Work waits, and so do edits, until it is called with false.
    void pause(bool paused);

    [[nodiscard]] State state() const;
    [[nodiscard]] std::shared_ptr<const Solution> newest() const;  // null before the first
    // The newest one that is not preliminary; null before the first.
    [[nodiscard]] std::shared_ptr<const Solution> newest_whole() const;

    // Holding it makes the work stand aside, for something that has to be quick.
    [[nodiscard]] PauseGate& gate() { return gate_; }
    // Rings when state() or newest() changed, but for the progress.
    [[nodiscard]] Bell& bell() { return bell_; }

private:
    struct Edit {
        std::shared_ptr<const StageInput> input;
        double sync_seconds;
    };

    void serve();
    void solve(const Edit& edit, Progress& progress);
    // earlier: what rays found there holds where nothing has moved since; null: nothing is known.
    SolvedScene solve_with(Stages& stages, StageInput input, const SolvedScene* earlier,
                           const Edit& edit, const std::vector<std::string>& warnings,
                           Progress& progress);
    // False: the edit changed more than the strength of lights.
    bool solve_relit(const StageInput& input, const Edit& edit,
                     const std::vector<std::string>& warnings, Progress& progress);
    static Report report_of(const Edit& edit, const std::vector<std::string>& warnings);
    void publish(SolvedScene solved, Report report, double seconds, bool preliminary);
    void finish(const std::string& error);
    [[nodiscard]] bool is_shielded() const;
    void shield();
    void unshield();

    PauseGate gate_;
    Bell bell_;
    Stages coarse_, whole_;                   // of the thread
    std::optional<SolvedScene> last_coarse_;  // of the thread

    mutable std::mutex mutex_;  // of what follows
    State state_;
    std::optional<Edit> waiting_;
    std::shared_ptr<const StageInput> last_posted_;
    std::shared_ptr<const StageInput> running_for_;
    Progress* running_ = nullptr;
    std::chrono::steady_clock::time_point shielded_until_;  // from edits; not from stop()
    std::shared_ptr<const Solution> newest_;
    std::shared_ptr<const Solution> newest_whole_;
    bool stop_ = false;

    std::thread thread_;  // last: it uses all the others
};

}  // namespace antiradiance
