// SPDX-License-Identifier: GPL-3.0-or-later
// Where the part of a picture is computed that is a sum over many nodes for each fragment.
//
//   auto backend = make_cpu_display();   // or make_gl_display(why_not)
//   Picture picture = make_picture(input, options, *backend, progress);
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "display/shooting.h"
#include "display/splatting.h"

namespace antiradiance {

// Kept between pictures: OpenGL's takes long over its shaders.
class DisplayBackend {
public:
    virtual ~DisplayBackend() = default;

    // Irradiance of every fragment (#fragments), W/m2, as the CPU's shoot() and splat() have it.
    // Throw Cancelled; gpu::GlError when the device fails.
    [[nodiscard]] virtual std::vector<vec3> shoot(const AntiradianceShooting& input,
                                                  Progress& progress, ProgressSpan span) = 0;
    [[nodiscard]] virtual std::vector<vec3> splat(const SplattingInput& input, Progress& progress,
                                                  ProgressSpan span) = 0;

    [[nodiscard]] virtual std::string name() const = 0;      // "CPU" or "OPENGL"
    [[nodiscard]] virtual std::string renderer() const = 0;  // of OpenGL, or the CPU's description
};

[[nodiscard]] std::unique_ptr<DisplayBackend> make_cpu_display();
// Null, with the reason in `why_not`, where OpenGL 4.5 can't be had.
[[nodiscard]] std::unique_ptr<DisplayBackend> make_gl_display(std::string& why_not);

}  // namespace antiradiance
