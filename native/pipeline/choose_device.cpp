// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/choose_device.h"

#include <stdexcept>

#include "gpu/gl_error.h"
#include "gpu/gl_thread.h"

namespace antiradiance {

namespace {

struct Chosen {
    bool opengl;
    std::string reason;
};

Chosen choose(SolverChoice choice, const std::string& stage) {
    if (choice == SolverChoice::kCpu) return {false, "asked for"};
    std::string why_not;
    const auto gl = gpu::GlThread::shared(why_not);
    if (choice == SolverChoice::kOpenGL) {
        if (gl) return {true, "asked for"};
        throw std::runtime_error("The OpenGL " + stage + " can't run: " + why_not +
                                 "; set Device to Automatic or CPU");
    }
    if (!gl) return {false, "there is no OpenGL 4.5 here: " + why_not};
    if (gl->device().is_software) {
        return {false, "the OpenGL renderer '" + gl->device().renderer +
                           "' is software, on which the CPU " + stage + " is faster"};
    }
    return {true, "a graphics card is at hand"};
}

}  // namespace

DeviceUse run_on_device(SolverChoice choice, const std::string& stage,
                        const std::function<void(bool opengl)>& work) {
    const Chosen chosen = choose(choice, stage);
    try {
        work(chosen.opengl);
        return {chosen.reason, ""};
    } catch (const gpu::GlError& failure) {
        if (choice == SolverChoice::kOpenGL) throw;
        const std::string why = "the OpenGL " + stage + " failed: " + failure.what();
        work(false);
        return {why, "The CPU's " + stage + " took over, because " + why};
    }
}

}  // namespace antiradiance
