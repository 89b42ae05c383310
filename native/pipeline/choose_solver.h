// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "solve/solver.h"

namespace antiradiance {

struct ChosenSolver {
    std::unique_ptr<Solver> solver;
    std::string reason;  // for the report
};

// AUTO takes OpenGL on a hardware renderer, else the CPU. Throws std::runtime_error when OPENGL is
// asked for and can't be had.
ChosenSolver choose_solver(SolverChoice choice);

}  // namespace antiradiance
