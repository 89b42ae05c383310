// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/gl_thread.h"

#include <utility>

namespace antiradiance::gpu {

GlThread::GlThread() {
    std::promise<void> ready;
    std::future<void> made = ready.get_future();
    thread_ = std::thread(&GlThread::serve, this, std::move(ready));
    try {
        made.get();
    } catch (...) {
        thread_.join();
        throw;
    }
}

GlThread::~GlThread() {
    {
        const std::scoped_lock lock(mutex_);
        stop_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

std::shared_ptr<GlThread> GlThread::shared(std::string& why_not) {
    struct Shared {
        std::shared_ptr<GlThread> thread;
        std::string failure;
        Shared() {
            try {
                thread = std::make_shared<GlThread>();
            } catch (const GlError& error) {
                failure = error.what();
            }
        }
    };
    // Destroyed at exit in reverse order of construction, so before what the driver, which is
    // loaded in the constructor, has registered: the context goes while the driver is whole.
    static const Shared shared;
    why_not = shared.failure;
    return shared.thread;
}

void GlThread::post(std::function<void()> job) {
    {
        const std::scoped_lock lock(mutex_);
        if (stop_) throw GlError("the OpenGL thread has ended");
        jobs_.push_back(std::move(job));
    }
    wake_.notify_one();
}

void GlThread::serve(std::promise<void> ready) {
    try {
        context_.emplace();
    } catch (...) {
        ready.set_exception(std::current_exception());
        return;
    }
    ready.set_value();

    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [this] { return stop_ || !jobs_.empty(); });
        if (jobs_.empty()) break;
        std::function<void()> job = std::move(jobs_.front());
        jobs_.pop_front();
        lock.unlock();
        job();  // a packaged_task: it throws nothing
        job = nullptr;
        lock.lock();
    }
    lock.unlock();
    context_.reset();
}

}  // namespace antiradiance::gpu
