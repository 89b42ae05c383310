// SPDX-License-Identifier: GPL-3.0-or-later
// The OpenGL sibling of splatting.h: the same sums by shaders/display/splat.comp.
#pragma once

#include <vector>

#include "display/splatting.h"
#include "display/work_runner_gl.h"

namespace antiradiance {

class GlSplatting {
public:
    explicit GlSplatting(WorkRunner& runner);  // compiles; throws gpu::GlError

    // As splat() of the CPU; throws gpu::GlError too.                                // #fragments
    [[nodiscard]] std::vector<vec3> splat(const SplattingInput& input, Progress& progress,
                                          ProgressSpan span);

private:
    WorkRunner& runner_;
    gpu::OnGlThread<gpu::Program> program_;
};

}  // namespace antiradiance
