// SPDX-License-Identifier: GPL-3.0-or-later
// The OpenGL sibling of shooting_antiradiance.cpp: the same sums by shaders/display/shoot.comp.
#pragma once

#include <vector>

#include "display/shooting.h"
#include "display/work_runner_gl.h"

namespace antiradiance {

class GlShooting {
public:
    explicit GlShooting(WorkRunner& runner);  // compiles; throws gpu::GlError

    // As shoot() of the CPU; throws gpu::GlError too.                                // #fragments
    [[nodiscard]] std::vector<vec3> shoot(const AntiradianceShooting& input, Progress& progress,
                                          ProgressSpan span);

private:
    WorkRunner& runner_;
    gpu::OnGlThread<gpu::Program> program_;
};

}  // namespace antiradiance
