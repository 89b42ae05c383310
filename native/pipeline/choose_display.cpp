// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/choose_display.h"

#include "gpu/gl_error.h"

namespace antiradiance {

DisplayBackend& ChosenDisplay::backend(bool opengl) {
    if (!opengl) return *cpu_;
    if (!opengl_) {
        std::string why_not;
        opengl_ = make_gl_display(why_not);
        if (!opengl_) throw gpu::GlError(why_not);
    }
    return *opengl_;
}

DisplayRun ChosenDisplay::make_picture(SolverChoice choice, const DisplayInput& input,
                                       const DisplayOptions& options, Progress& progress) {
    // A mode without work for a device must not fail for want of one.
    if (!uses_backend(options)) choice = SolverChoice::kCpu;
    DisplayRun run;
    run.device = run_on_device(choice, "display", [&](bool opengl) {
        DisplayBackend& chosen = backend(opengl);
        run.picture = antiradiance::make_picture(input, options, chosen, progress);
        run.backend = chosen.name();
        run.renderer = chosen.renderer();
    });
    return run;
}

}  // namespace antiradiance
