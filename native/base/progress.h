// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <string>

namespace antiradiance {

// How a long stage talks to its caller. Stages call `check()` at least every 0.1 s of work on every
// thread; it throws Cancelled once the caller asked to stop. `report()` may be called from the
// thread that runs the stage only (the callbacks may end in Python).
class Progress {
public:
    using Report = std::function<void(float fraction, const std::string& stage)>;
    using IsCancelled = std::function<bool()>;

    Progress() = default;
    Progress(Report report, IsCancelled is_cancelled)
        : report_(std::move(report)), is_cancelled_(std::move(is_cancelled)) {}
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // The following reports fill [begin, end] of the whole bar under the name `stage`.
    void begin_stage(std::string stage, float begin, float end);

    // fraction: of the current stage, 0..1. Also polls the caller for cancellation.
    void report(float fraction);

    // From any thread; cheap (one atomic load).
    void check() const;
    [[nodiscard]] bool cancelled() const { return cancel_.load(std::memory_order_relaxed); }
    // From any thread: make every following check() throw.
    void cancel() { cancel_.store(true, std::memory_order_relaxed); }

private:
    Report report_;
    IsCancelled is_cancelled_;
    std::string stage_;
    float begin_ = 0;
    float end_ = 1;
    std::atomic<bool> cancel_{false};
};

}  // namespace antiradiance
