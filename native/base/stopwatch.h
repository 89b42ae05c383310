// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

namespace antiradiance {

class Stopwatch {
public:
    // Seconds since construction or the last lap.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - begin_).count();
        begin_ = now;
        return seconds;
    }

private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace antiradiance
