// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/choose_solver.h"

#include <memory>
#include <stdexcept>

#include "gpu/gl_error.h"
#include "gpu/gl_thread.h"

namespace antiradiance {

namespace {

struct Chosen {
    std::unique_ptr<Solver> solver;
    std::string reason;
};

Chosen choose(SolverChoice choice) {
    if (choice == SolverChoice::kCpu) return {make_cpu_solver(), "asked for"};
    std::string why_not;
    const auto gl = gpu::GlThread::shared(why_not);
    if (choice == SolverChoice::kAuto) {
        if (!gl) return {make_cpu_solver(), "there is no OpenGL 4.5 here: " + why_not};
        if (gl->device().is_software) {
            return {make_cpu_solver(), "the OpenGL renderer '" + gl->device().renderer +
                                           "' is software, on which the CPU solver is faster"};
        }
    }
    std::unique_ptr<Solver> solver = gl ? make_gl_solver(why_not) : nullptr;
    if (solver)
        return {std::move(solver),
                choice == SolverChoice::kOpenGL ? "asked for" : "a graphics card is at hand"};
    if (choice == SolverChoice::kOpenGL) {
        throw std::runtime_error("The OpenGL solver can't run: " + why_not +
                                 "; set Solver to Automatic or CPU");
    }
    return {make_cpu_solver(), "the OpenGL solver can't run: " + why_not};
}

}  // namespace

SolverRun solve_transport(SolverChoice choice, const TransportProblem& problem,
                          const SolveOptions& options, Progress& progress) {
    Chosen chosen = choose(choice);
    try {
        return {chosen.solver->solve(problem, options, progress), chosen.reason, ""};
    } catch (const gpu::GlError& failure) {
        if (choice == SolverChoice::kOpenGL) throw;
        const std::string why = std::string("the OpenGL solver failed: ") + failure.what();
        return {make_cpu_solver()->solve(problem, options, progress), why,
                "Solved on the CPU, because " + why};
    }
}

}  // namespace antiradiance
