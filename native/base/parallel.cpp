// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace antiradiance {

namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(20);

#ifdef __SANITIZE_THREAD__

// TBB orders its tasks inside a library that the thread sanitizer cannot see into, so each loop
// would be reported as a race. Plain threads show it the same bodies.
void run_on_all_cores(const std::function<void()>& work) {
    std::mutex mutex;
    std::exception_ptr error;
    std::vector<std::jthread> threads;
    for (unsigned t = 0; t < std::max(2U, std::thread::hardware_concurrency()); ++t) {
        threads.emplace_back([&] {
            try {
                work();
            } catch (...) {
                const std::scoped_lock lock(mutex);
                if (!error) error = std::current_exception();
            }
        });
    }
    threads.clear();  // joins
    if (error) std::rethrow_exception(error);
}

#else

void run_on_all_cores(const std::function<void()>& work) {
    tbb::parallel_for(
        0, tbb::this_task_arena::max_concurrency(), [&](int) { work(); },
        tbb::simple_partitioner{});
}

#endif

// Bodies take the next index each, so that a pause or an error leaves none out and begins none.
void loop_on_all_cores(std::size_t count, const Progress& progress,
                       const std::function<void(std::size_t)>& body) {
    std::atomic<std::size_t> next{0};
    const auto drain = [&] {
        try {
            while (!progress.paused()) {
                const std::size_t i = next.fetch_add(1, std::memory_order_relaxed);
                if (i >= count) return;
                progress.check();
                body(i);
            }
        } catch (...) {
            next = count;
            throw;
        }
    };
    while (next < count) {
        progress.wait_while_paused();
        run_on_all_cores(drain);
    }
}

}  // namespace

void parallel_for(std::size_t count, Progress& progress,
                  const std::function<void(std::size_t)>& body, ProgressSpan span) {
    if (count == 0) return;
    if (count == 1) {
        progress.report(span.begin);
        body(0);
        return;
    }

    std::atomic<std::size_t> done{0};
    std::mutex mutex;
    std::condition_variable finished_changed;
    bool finished = false;
    std::exception_ptr loop_error;

    std::thread loop([&] {
        try {
            loop_on_all_cores(count, progress, [&](std::size_t i) {
                body(i);
                done.fetch_add(1, std::memory_order_relaxed);
            });
        } catch (...) {
            loop_error = std::current_exception();
        }
        const std::scoped_lock lock(mutex);
        finished = true;
        finished_changed.notify_one();
    });

    std::exception_ptr callback_error;
    {
        std::unique_lock lock(mutex);
        while (!finished_changed.wait_for(lock, kPollInterval, [&] { return finished; })) {
            if (callback_error) continue;
            lock.unlock();
            try {
                const float fraction = static_cast<float>(done.load()) / static_cast<float>(count);
                progress.report(span.begin + (span.end - span.begin) * fraction);
            } catch (...) {
                callback_error = std::current_exception();
                progress.cancel();
            }
            lock.lock();
        }
    }
    loop.join();
    // The callback's own error is the cause when both are set: the bodies only saw the
    // cancellation.
    if (callback_error) std::rethrow_exception(callback_error);
    if (loop_error) std::rethrow_exception(loop_error);
}

void parallel_for_blocks(std::size_t count, std::size_t block, Progress& progress,
                         const std::function<void(std::size_t, std::size_t)>& body,
                         ProgressSpan span) {
    const std::size_t blocks = (count + block - 1) / block;
    parallel_for(
        blocks, progress, [&](std::size_t i) { body(i * block, std::min(count, (i + 1) * block)); },
        span);
}

}  // namespace antiradiance
