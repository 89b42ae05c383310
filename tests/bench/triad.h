// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <benchmark/benchmark.h>

namespace antiradiance::bench {

// Bytes/s that all cores together move in a[i] = b[i] + s c[i] (McCalpin 1995, STREAM): 24 an
// element, as STREAM counts. About 50 ms.
double triad_rate();

// Measures the triad before and after a benchmark, so that a figure from a busy machine can be told
// by its share of what the memory gave at that time.
class TriadBound {
public:
    explicit TriadBound(benchmark::State& state) : state_(state), before_(triad_rate()) {}

    // Counters: `triad` (bytes/s), `bound` (items/s at which `bytes` an item fill the memory's
    // rate) and `of_bound` (the share of it that `rate` items/s are).
    void report(double rate, double bytes) const;

private:
    benchmark::State& state_;
    double before_;
};

}  // namespace antiradiance::bench
