// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/choose_solver.h"

#include <stdexcept>

namespace antiradiance {

ChosenSolver choose_solver(SolverChoice choice) {
    if (choice == SolverChoice::kOpenGL) throw std::runtime_error("no OpenGL solver yet");
    return {make_cpu_solver(), choice == SolverChoice::kCpu ? "asked for" : "no OpenGL solver yet"};
}

}  // namespace antiradiance
