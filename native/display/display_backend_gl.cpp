// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/display_backend_gl.h"

#include <optional>

#include "display/shooting_gl.h"
#include "display/splatting_gl.h"

namespace antiradiance {

namespace {

class GlDisplay final : public DisplayBackend {
public:
    GlDisplay(const std::shared_ptr<gpu::GlThread>& thread, const GlDisplayConfig& config)
        : renderer_(thread->device().renderer), runner_(thread, config) {}

    std::vector<vec3> shoot(const AntiradianceShooting& input, Progress& progress,
                            ProgressSpan span) override {
        if (!shooting_) shooting_.emplace(runner_);
        return shooting_->shoot(input, progress, span);
    }
    std::vector<vec3> splat(const SplattingInput& input, Progress& progress,
                            ProgressSpan span) override {
        if (!splatting_) splatting_.emplace(runner_);
        return splatting_->splat(input, progress, span);
    }
    std::string name() const override { return "OPENGL"; }
    std::string renderer() const override { return renderer_; }

private:
    std::string renderer_;
    WorkRunner runner_;
    // Compiled when they are first used, and kept.
    std::optional<GlShooting> shooting_;
    std::optional<GlSplatting> splatting_;
};

}  // namespace

std::unique_ptr<DisplayBackend> make_gl_display(const GlDisplayConfig& config,
                                                std::string& why_not) {
    const std::shared_ptr<gpu::GlThread> thread = gpu::GlThread::shared(why_not);
    if (!thread) return nullptr;
    return std::make_unique<GlDisplay>(thread, config);
}

std::unique_ptr<DisplayBackend> make_gl_display(std::string& why_not) {
    return make_gl_display({}, why_not);
}

}  // namespace antiradiance
