// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/choose_device.h"
#include "solve/solver.h"

namespace antiradiance {

struct SolverRun {
    Solution solution;
    DeviceUse device;
};

// Solves on the back end of the artist's choice (choose_device.h).
SolverRun solve_transport(SolverChoice choice, const TransportProblem& problem,
                          const SolveOptions& options, Progress& progress);

}  // namespace antiradiance
