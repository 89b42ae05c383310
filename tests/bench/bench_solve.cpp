// SPDX-License-Identifier: GPL-3.0-or-later
// Bounces over the link mesh, without what a solver sets up before the first.
#include <benchmark/benchmark.h>

#include <string>

#include "stages.h"
#include "triad.h"

namespace antiradiance::bench {

namespace {

constexpr int kBounces = 4;

void solve(benchmark::State& state, Visibility visibility, std::unique_ptr<Solver> solver,
           int iterations) {
    const Stages& room = stages(visibility);
    const LinkSet& set = room.model.links;
    SolveOptions options;
    options.iterations = iterations;
    const TriadBound bound(state);
    double seconds = 0;
    double bounces = 0;
    for (auto _ : state) {
        Progress progress;
        const Solution solution = solver->solve(room.problem(), options, progress);
        state.SetIterationTime(solution.seconds);
        seconds += solution.seconds;
        bounces += solution.iterations;
        state.SetLabel(solution.renderer);
    }
    const auto links = static_cast<double>(set.links.size());
    const double rate = links * bounces / seconds;
    state.counters["links"] = links;
    state.counters["links/s"] = rate;
    state.counters["bounces"] = bounces / static_cast<double>(state.iterations());
    state.counters["bytes/link"] = static_cast<double>(set.bytes()) / links;
    bound.report(rate, static_cast<double>(set.bytes()) / links);
}

void cpu_solve(benchmark::State& state, Visibility visibility, int iterations) {
    solve(state, visibility, make_cpu_solver(), iterations);
}

void opengl_solve(benchmark::State& state, Visibility visibility, int iterations) {
    std::string why_not;
    std::unique_ptr<Solver> solver = make_gl_solver(why_not);
    if (!solver) {
        state.SkipWithError(why_not.c_str());
        return;
    }
    solve(state, visibility, std::move(solver), iterations);
}

// To convergence, and the paper's scheme for a fixed count.
#define SOLVE_BENCHMARKS(function)                                                    \
    BENCHMARK_CAPTURE(function, IMPLICIT, Visibility::kImplicit, 0)->UseManualTime(); \
    BENCHMARK_CAPTURE(function, EXPLICIT, Visibility::kExplicit, 0)->UseManualTime(); \
    BENCHMARK_CAPTURE(function, IMPLICIT_Jacobi, Visibility::kImplicit, kBounces)->UseManualTime()
SOLVE_BENCHMARKS(cpu_solve);
SOLVE_BENCHMARKS(opengl_solve);

}  // namespace

}  // namespace antiradiance::bench
