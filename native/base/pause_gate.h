// SPDX-License-Identifier: GPL-3.0-or-later
// Lets long work stand aside for what is more urgent: while somebody holds the gate, the loops of
// whoever has it in its Progress stop between two bodies and leave the cores to others.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>

namespace antiradiance {

class PauseGate {
public:
    // Closed until release() was called as often as hold(). From any thread.
    void hold() {
        const std::scoped_lock lock(mutex_);
        ++holds_;
        held_.store(true, std::memory_order_relaxed);
    }
    void release() {
        const std::scoped_lock lock(mutex_);
        if (--holds_ > 0) return;
        held_.store(false, std::memory_order_relaxed);
        opened_.notify_all();
    }
    [[nodiscard]] bool held() const { return held_.load(std::memory_order_relaxed); }

    // Waits until the gate is open or the time is up.
    void wait(std::chrono::milliseconds most) const {
        std::unique_lock lock(mutex_);
        opened_.wait_for(lock, most, [this] { return holds_ == 0; });
    }

private:
    mutable std::mutex mutex_;
    mutable std::condition_variable opened_;
    int holds_ = 0;
    std::atomic<bool> held_{false};
};

}  // namespace antiradiance
