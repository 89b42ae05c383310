// SPDX-License-Identifier: GPL-3.0-or-later
// Draws what a viewport shows of a solution beside its picture, and keeps what does not depend on
// the camera.
#pragma once

#include <memory>
#include <optional>

#include "inspect/inspect.h"
#include "live/live_solver.h"
#include "pipeline/stages.h"

namespace antiradiance {

class Inspector {
public:
    // As inspect() and draw(). The EXPLICIT solution that a difference asks for is made here.
    [[nodiscard]] Picture draw(const std::shared_ptr<const LiveSolver::Solution>& solution,
                               const InspectOptions& options, const Camera& camera,
                               int samples_per_axis, Progress& progress);

private:
    [[nodiscard]] Inspection inspect_now(Progress& progress);

    std::shared_ptr<const LiveSolver::Solution> solution_;
    InspectOptions options_;
    std::optional<Inspection> inspection_;  // of these; none: not made yet
    Stages explicit_;
};

}  // namespace antiradiance
