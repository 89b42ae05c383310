// SPDX-License-Identifier: GPL-3.0-or-later
// Wakes threads that wait for any of several things: whoever changes one of them rings.
//
//   const std::uint64_t heard = bell.rings();
//   if (!there_is_work()) bell.wait(heard);   // returns at once if it rang in between
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace antiradiance {

class Bell {
public:
    void ring() {
        const std::scoped_lock lock(mutex_);
        ++rings_;
        rang_.notify_all();
    }
    [[nodiscard]] std::uint64_t rings() const {
        const std::scoped_lock lock(mutex_);
        return rings_;
    }
    // Until there were more rings than `heard`.
    void wait(std::uint64_t heard) const {
        std::unique_lock lock(mutex_);
        rang_.wait(lock, [&] { return rings_ > heard; });
    }
    void wait_for(std::uint64_t heard, std::chrono::duration<double> most) const {
        std::unique_lock lock(mutex_);
        rang_.wait_for(lock, most, [&] { return rings_ > heard; });
    }

private:
    mutable std::mutex mutex_;
    mutable std::condition_variable rang_;
    std::uint64_t rings_ = 0;
};

}  // namespace antiradiance
