// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "base/pause_gate.h"

namespace antiradiance {

// How a long stage talks to its caller. Stages call `check()` at least every 0.1 s of work on every
// thread; it throws Cancelled once the caller asked to stop. `report()` may be called from the
// thread that runs the stage only (the callbacks may end in Python).
class Progress {
public:
    using Report = std::function<void(float fraction, const std::string& stage)>;
    using IsCancelled = std::function<bool()>;

    Progress() = default;
    // gate: what can make the work wait, or null; must outlive this.
    Progress(Report report, IsCancelled is_cancelled, const PauseGate* gate = nullptr)
        : report_(std::move(report)), is_cancelled_(std::move(is_cancelled)), gate_(gate) {}
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // The following reports fill [begin, end] of the whole bar under the name `stage`.
    void begin_stage(std::string stage, float begin, float end);

    // fraction: of the current stage, 0..1. Also polls the caller for cancellation, and waits while
    // the work is paused.
    void report(float fraction);

    // From any thread; cheap (one atomic load).
    void check() const;
    [[nodiscard]] bool cancelled() const { return cancel_.load(std::memory_order_relaxed); }
    // From any thread: make every following check() throw.
    void cancel() { cancel_.store(true, std::memory_order_relaxed); }

    // Whether a loop should give the cores back and go on after wait_while_paused().
    [[nodiscard]] bool paused() const { return gate_ != nullptr && gate_->held(); }
    // From any thread; throws Cancelled.
    void wait_while_paused() const;

private:
    void poll();

    Report report_;
    IsCancelled is_cancelled_;
    const PauseGate* gate_ = nullptr;
    std::string stage_;
    float begin_ = 0;
    float end_ = 1;
    std::atomic<bool> cancel_{false};
};

}  // namespace antiradiance
