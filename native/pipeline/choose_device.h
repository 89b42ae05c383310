// SPDX-License-Identifier: GPL-3.0-or-later
// Where the artist's choice of a device puts a stage's work: one rule for the solver and the
// display.
#pragma once

#include <functional>
#include <string>

#include "solve/solve_options.h"

namespace antiradiance {

struct DeviceUse {
    std::string reason;   // why this back end; for the report
    std::string warning;  // empty, or why another one had to take over
};

// Calls work(opengl) for the back end of the artist's choice. AUTO takes OpenGL on a graphics card;
// a software renderer shares the cores with the CPU's code and is slower there (tests/bench), so
// then, and when the device fails, the CPU works: in the latter case work() is called twice. Throws
// std::runtime_error when OPENGL is asked for and can't be had or fails.
// stage: what runs, as in "the OpenGL solver failed".
DeviceUse run_on_device(SolverChoice choice, const std::string& stage,
                        const std::function<void(bool opengl)>& work);

}  // namespace antiradiance
