// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind/callbacks.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "base/error.h"

namespace py = pybind11;

namespace antiradiance {

namespace {

// How often `cancelled` is asked. Stages look at the answer every 0.1 s or sooner (Progress).
constexpr std::chrono::milliseconds kPollInterval{50};
// How often progress is told within a stage: Blender prints a line each time, and draws the bar.
constexpr std::chrono::milliseconds kReportInterval{200};

// The two callbacks of a render. An exception in one of them cancels the render and is kept, so
// that no Python exception travels through the core's threads.
class Callbacks {
public:
    Callbacks(py::object progress, py::object cancelled)
        : progress_(std::move(progress)), cancelled_(std::move(cancelled)) {}

    void report(Progress& progress, float fraction, const std::string& stage) {
        const auto now = std::chrono::steady_clock::now();
        if (progress_.is_none() || (stage == stage_ && now - reported_ < kReportInterval)) {
            return;
        }
        stage_ = stage;
        reported_ = now;
        guarded(progress, [&] { progress_(fraction, stage); });
    }

    void poll(Progress& progress) {
        guarded(progress, [&] {
            if (py::bool_(cancelled_())) {
                progress.cancel();
            }
        });
    }

    [[nodiscard]] bool polls() const { return !cancelled_.is_none(); }

    void rethrow() const {
        if (error_) {
            std::rethrow_exception(error_);
        }
    }

private:
    template <typename Call>
    void guarded(Progress& progress, const Call& call) {
        const py::gil_scoped_acquire gil;
        if (error_) {
            return;
        }
        try {
            call();
        } catch (...) {
            error_ = std::current_exception();
            progress.cancel();
        }
    }

    py::object progress_, cancelled_;
    std::string stage_;                               // of the last report
    std::chrono::steady_clock::time_point reported_;  // when it was made
    std::exception_ptr error_;                        // written and read with the GIL held
};

// Asks `cancelled` from a thread of its own, so that no stage has to come back to Python for it.
class CancelWatch {
public:
    CancelWatch(Callbacks& callbacks, Progress& progress) {
        if (callbacks.polls()) {
            thread_ = std::jthread([&](const std::stop_token& stop) {
                std::mutex mutex;
                std::condition_variable_any wake;
                std::unique_lock lock(mutex);
                while (!stop.stop_requested() && !progress.cancelled()) {
                    callbacks.poll(progress);
                    wake.wait_for(lock, stop, kPollInterval, [] { return false; });
                }
            });
        }
    }

private:
    std::jthread thread_;
};

}  // namespace

bool run_with_callbacks(py::object progress_callback, py::object cancelled,
                        const std::function<void(Progress&)>& work) {
    Callbacks callbacks(std::move(progress_callback), std::move(cancelled));
    bool done = true;
    {
        const py::gil_scoped_release no_gil;
        Progress* self = nullptr;
        Progress progress(
            [&](float fraction, const std::string& stage) {
                callbacks.report(*self, fraction, stage);
            },
            {});
        self = &progress;
        const CancelWatch watch(callbacks, progress);
        try {
            work(progress);
        } catch (const Cancelled&) {
            done = false;
        }
    }
    callbacks.rethrow();
    return done;
}

}  // namespace antiradiance
