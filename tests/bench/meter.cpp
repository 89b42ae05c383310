// SPDX-License-Identifier: GPL-3.0-or-later
#include "meter.h"

#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"

namespace antiradiance::bench {

namespace {

constexpr std::size_t kCount = std::size_t{1} << 23U;  // 64 MB an array: no cache holds it
constexpr std::size_t kBlock = std::size_t{1} << 18U;
constexpr int kRepeats = 3;

}  // namespace

double triad_rate() {
    static std::vector<double> a(kCount, 0);
    static const std::vector<double> b(kCount, 1);
    static const std::vector<double> c(kCount, 2);
    Progress progress;
    double best = 0;
    for (int i = 0; i < kRepeats; ++i) {
        Stopwatch watch;
        parallel_for_blocks(kCount, kBlock, progress, [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k)
                a[k] = b[k] + 3.0 * c[k];
        });
        best = std::max(best, 3.0 * sizeof(double) * kCount / watch.lap());
    }
    benchmark::DoNotOptimize(a.data());
    return best;
}

void Meter::report(const std::string& name, double items, double bytes) const {
    const double all = items * static_cast<double>(state_.iterations());
    const double triad = 0.5 * (triad_before_ + triad_rate());
    state_.counters[name + "/s"] = all / seconds_;
    state_.counters[name + "/core_s"] = all / cpu_seconds_;
    state_.counters["triad"] = triad;
    state_.counters["bound"] = triad / bytes;
    state_.counters["of_bound"] = all / seconds_ * bytes / triad;
}

}  // namespace antiradiance::bench
