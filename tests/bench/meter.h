// SPDX-License-Identifier: GPL-3.0-or-later
// Rates that can be told on a machine that others use as well: beside the clock's, what a core
// does in a second of its own time, and the share of what the memory gives at that moment.
#pragma once

#include <benchmark/benchmark.h>

#include <chrono>
#include <ctime>

namespace antiradiance::bench {

// Bytes/s that all cores together move in a[i] = b[i] + s c[i] (McCalpin 1995, STREAM): 24 an
// element, as STREAM counts. About 50 ms.
double triad_rate();

class Meter {
public:
    explicit Meter(benchmark::State& state) : state_(state), triad_before_(triad_rate()) {}

    // The timed part of an iteration; `items` as they are counted in the rate.
    template <typename Work>
    void time(const Work& work) {
        const auto wall = std::chrono::steady_clock::now();
        const std::clock_t cpu = std::clock();
        work();
        cpu_seconds_ += static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - wall;
        state_.SetIterationTime(elapsed.count());
        seconds_ += elapsed.count();
    }

    // Counters, for `items` a call of time():
    //   NAME/s        by the clock
    //   NAME/core_s   by the processor time of all threads: times the cores, the rate of a machine
    //                 that does nothing else
    //   triad         bytes/s before and after, on average
    //   bound         items/s at which `bytes` an item fill that rate
    //   of_bound      the share of it that was reached
    void report(const std::string& name, double items, double bytes) const;

private:
    benchmark::State& state_;
    double triad_before_;
    double seconds_ = 0;
    double cpu_seconds_ = 0;
};

}  // namespace antiradiance::bench
