// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "display/display.h"
#include "pipeline/choose_device.h"

namespace antiradiance {

struct DisplayRun {
    Picture picture;
    std::string backend;   // "CPU" or "OPENGL"
    std::string renderer;  // of OpenGL, or the CPU's description
    DeviceUse device;
};

// Makes pictures on the back end of the artist's choice (choose_device.h). Keeps what OpenGL has
// compiled from picture to picture.
class ChosenDisplay {
public:
    DisplayRun make_picture(SolverChoice choice, const DisplayInput& input,
                            const DisplayOptions& options, Progress& progress);

private:
    DisplayBackend& backend(bool opengl);

    std::unique_ptr<DisplayBackend> cpu_ = make_cpu_display();
    std::unique_ptr<DisplayBackend> opengl_;  // made on first use
};

}  // namespace antiradiance
