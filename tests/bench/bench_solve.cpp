// SPDX-License-Identifier: GPL-3.0-or-later
// Bounces over the link mesh, without what a solver sets up before the first.
#include <benchmark/benchmark.h>

#include <string>

#include "meter.h"
#include "solve/transport.h"
#include "stages.h"

namespace antiradiance::bench {

namespace {

// As many of the converging scheme, or of the paper's Jacobi scheme.
struct Bounces {
    int count;
    bool jacobi = false;
};

// solver_bytes: what the solver keeps beside the link mesh.
void solve(benchmark::State& state, Visibility visibility, Solver& solver, std::size_t solver_bytes,
           Bounces bounces) {
    const Stages& room = stages(visibility);
    const LinkSet& set = room.model.links;
    SolveOptions options;
    if (bounces.jacobi) {
        options.iterations = bounces.count;
    } else {
        options.tolerance = 0;
        options.max_iterations = bounces.count;
    }
    Progress progress;
    const SolveOptions once{.iterations = 1};
    benchmark::DoNotOptimize(solver.solve(room.problem(), once, progress));  // compiles shaders
    Meter meter(state);
    double seconds = 0;
    for (auto _ : state) {
        meter.time([&] {
            const Solution solution = solver.solve(room.problem(), options, progress);
            seconds += solution.seconds;
            state.SetLabel(solution.renderer);
        });
    }
    const auto links = static_cast<double>(set.links.size());
    const double bytes = static_cast<double>(set.bytes() + solver_bytes) / links;
    state.counters["links"] = links;
    state.counters["bytes/link"] = bytes;  // all that is kept, but for what each node takes
    meter.report("links", links * bounces.count, bytes);
    // Of the iterations alone, as the report has it; the others hold the set-up as well.
    state.counters["links/solve_s"] =
        links * bounces.count * static_cast<double>(state.iterations()) / seconds;
}

void cpu_solve(benchmark::State& state, Visibility visibility, Bounces bounces) {
    const Model& model = stages(visibility).model;
    solve(state, visibility, *make_cpu_solver(), Transport(model.tree, model.links).bytes(),
          bounces);
}

void opengl_solve(benchmark::State& state, Visibility visibility, Bounces bounces) {
    std::string why_not;
    const std::unique_ptr<Solver> solver = make_gl_solver(why_not);
    if (!solver) {
        state.SkipWithError(why_not.c_str());
        return;
    }
    // Links and segments take as much on the device; a segment has a flux of three floats there and
    // a place in the list of its receiver.
    const std::size_t per_segment = 3 * sizeof(float) + sizeof(std::uint32_t);
    const std::size_t segments = stages(visibility).model.links.segments.size();
    solve(state, visibility, *solver, per_segment * segments, bounces);
}

constexpr Bounces kMany{64};
constexpr Bounces kFew{4};  // a software renderer takes seconds a bounce
constexpr Bounces kManyJacobi{64, true};
constexpr Bounces kFewJacobi{4, true};

BENCHMARK_CAPTURE(cpu_solve, IMPLICIT, Visibility::kImplicit, kMany)->UseManualTime();
BENCHMARK_CAPTURE(cpu_solve, IMPLICIT_Jacobi, Visibility::kImplicit, kManyJacobi)->UseManualTime();
BENCHMARK_CAPTURE(cpu_solve, EXPLICIT, Visibility::kExplicit, kMany)->UseManualTime();
BENCHMARK_CAPTURE(opengl_solve, IMPLICIT, Visibility::kImplicit, kFew)->UseManualTime();
BENCHMARK_CAPTURE(opengl_solve, IMPLICIT_Jacobi, Visibility::kImplicit, kFewJacobi)
    ->UseManualTime();
BENCHMARK_CAPTURE(opengl_solve, EXPLICIT, Visibility::kExplicit, kFew)->UseManualTime();

}  // namespace

}  // namespace antiradiance::bench
