// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/display_backend.h"

#include <thread>

namespace antiradiance {

namespace {

class CpuDisplay final : public DisplayBackend {
public:
    std::vector<vec3> shoot(const AntiradianceShooting& input, Progress& progress,
                            ProgressSpan span) override {
        return antiradiance::shoot(input, progress, span);
    }
    std::vector<vec3> splat(const SplattingInput& input, Progress& progress,
                            ProgressSpan span) override {
        return antiradiance::splat(input, progress, span);
    }
    std::string name() const override { return "CPU"; }
    std::string renderer() const override {
        return "CPU, " + std::to_string(std::thread::hardware_concurrency()) + " threads";
    }
};

}  // namespace

std::unique_ptr<DisplayBackend> make_cpu_display() {
    return std::make_unique<CpuDisplay>();
}

}  // namespace antiradiance
