// SPDX-License-Identifier: GPL-3.0-or-later
// The thread that owns the OpenGL context. EGL can't make a context current on Blender's main
// thread, where Blender's own is; and a render comes from another thread each time. So one thread
// holds the context and everybody else sends it work.
//
//   std::string why_not;
//   if (auto gl = GlThread::shared(why_not)) {
//       gl->run([&](GlContext& context) { ... OpenGL calls ... });
//   }
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>

#include "gpu/gl_context.h"

namespace antiradiance::gpu {

class GlThread {
public:
    // Starts the thread and makes the context; throws GlError.
    GlThread();
    // Finishes the work in the queue and destroys the context.
    ~GlThread();
    GlThread(const GlThread&) = delete;
    GlThread& operator=(const GlThread&) = delete;

    // The process's one thread, made on first use; null, with the reason, where there is no OpenGL
    // (the answer is kept: a driver does not appear while we run). It is process-wide because the
    // thing it stands for is: a context costs half a second and its compiled shaders, Blender makes
    // a new engine for every frame, and drivers handle few contexts better than many. It ends at
    // process exit, or with the last user after that.
    [[nodiscard]] static std::shared_ptr<GlThread> shared(std::string& why_not);

    [[nodiscard]] const DeviceInfo& device() const { return context_->device(); }

    // Calls work(GlContext&) on the thread, waits for it and returns its result. Its exceptions
    // come out here, and a GlError if OpenGL calls in it failed. Python's lock must not be held:
    // another thread's work may be waiting for it.
    template <class Work>
    auto run(Work&& work) -> std::invoke_result_t<Work&, GlContext&> {
        using Result = std::invoke_result_t<Work&, GlContext&>;
        // Shared with the queue: the thread may still be inside the task when its result is here.
        auto task = std::make_shared<std::packaged_task<Result()>>([&]() -> Result {
            context_->forget_errors();  // of work that ended in an exception
            if constexpr (std::is_void_v<Result>) {
                work(*context_);
                context_->check("OpenGL");
            } else {
                Result result = work(*context_);
                context_->check("OpenGL");
                return result;
            }
        });
        std::future<Result> future = task->get_future();
        if (std::this_thread::get_id() == thread_.get_id()) {
            (*task)();
        } else {
            post([task] { (*task)(); });
        }
        return future.get();
    }

private:
    void post(std::function<void()> job);
    void serve(std::promise<void> ready);

    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<std::function<void()>> jobs_;
    bool stop_ = false;
    std::optional<GlContext> context_;  // of thread_
    std::thread thread_;
};

// Owns a T that holds OpenGL objects: made, used and destroyed on the thread, from any thread.
template <class T>
class OnGlThread {
public:
    // make(GlContext&) -> std::unique_ptr<T>
    template <class Make>
    OnGlThread(std::shared_ptr<GlThread> thread, Make&& make) : thread_(std::move(thread)) {
        value_ = thread_->run(make);
    }
    ~OnGlThread() {
        if (!value_) return;
        try {
            thread_->run([this](GlContext&) { value_.reset(); });
        } catch (const std::exception&) {
            // The device failed, which nobody waits to hear any more.
            (void)value_.release();
        }
    }
    OnGlThread(OnGlThread&&) noexcept = default;
    OnGlThread& operator=(OnGlThread&&) = delete;

    // work(T&, GlContext&)
    template <class Work>
    auto run(Work&& work) {
        return thread_->run([&](GlContext& context) { return work(*value_, context); });
    }

private:
    std::shared_ptr<GlThread> thread_;
    std::unique_ptr<T> value_;
};

}  // namespace antiradiance::gpu
