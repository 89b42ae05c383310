// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "solve/solver.h"

namespace antiradiance {

struct SolverRun {
    Solution solution;
    std::string reason;   // why this back end; for the report
    std::string warning;  // empty, or why another one had to take over
};

// Solves on the back end of the artist's choice. AUTO takes OpenGL on a graphics card; a software
// renderer shares the cores with the CPU solver and is slower there (tests/bench), so then, and
// when the device fails, the CPU solves. Throws std::runtime_error when OPENGL is asked for and
// can't be had or fails.
SolverRun solve_transport(SolverChoice choice, const TransportProblem& problem,
                          const SolveOptions& options, Progress& progress);

}  // namespace antiradiance
