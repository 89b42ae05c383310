// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/choose_solver.h"

#include "gpu/gl_error.h"

namespace antiradiance {

namespace {

std::unique_ptr<Solver> make_solver(bool opengl) {
    if (!opengl) return make_cpu_solver();
    std::string why_not;
    std::unique_ptr<Solver> solver = make_gl_solver(why_not);
    if (!solver) throw gpu::GlError(why_not);
    return solver;
}

}  // namespace

SolverRun solve_transport(SolverChoice choice, const TransportProblem& problem,
                          const SolveOptions& options, Progress& progress) {
    SolverRun run;
    run.device = run_on_device(choice, "solver", [&](bool opengl) {
        run.solution = make_solver(opengl)->solve(problem, options, progress);
    });
    return run;
}

}  // namespace antiradiance
