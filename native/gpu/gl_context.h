// SPDX-License-Identifier: GPL-3.0-or-later
// An OpenGL 4.5 core context with no window: EGL on a device or surfaceless.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "gpu/gl_error.h"

namespace antiradiance::gpu {

struct DeviceInfo {
    std::string vendor;
    std::string
        renderer;  // GL_RENDERER: "llvmpipe (LLVM 15.0.6, 256 bits)", "NVIDIA H100/PCIe/SSE2"
    std::string version;                      // GL_VERSION
    bool is_software = false;                 // a rasteriser that runs on the CPU
    std::size_t max_storage_block_bytes = 0;  // of one SSBO; 128 MiB on llvmpipe
    int max_compute_storage_blocks = 0;       // SSBOs that one compute shader may use
    std::size_t max_work_groups = 0;          // along x, of one dispatch
    std::size_t free_bytes = 0;               // of device memory at the start; 0: not known
};

// Current on the thread that made it, from construction to destruction. Other threads get at it
// through GlThread.
class GlContext {
public:
    // Hardware devices first, then Mesa's surfaceless platform, then software devices. Throws
    // GlError with what each of them answered.
    GlContext();
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    [[nodiscard]] const DeviceInfo& device() const { return device_; }

    // Waits until the device has done everything it was given.
    void finish();

    // Throws GlError with the driver's messages if a call since the last check failed.
    void check(const std::string& what);
    void forget_errors();

private:
    struct Egl;
    std::unique_ptr<Egl> egl_;
    DeviceInfo device_;
    std::string messages_;  // errors from the driver's debug output, one a line

    void listen_to_driver();
    [[nodiscard]] std::string take_errors();
};

}  // namespace antiradiance::gpu
