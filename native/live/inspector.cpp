// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/inspector.h"

#include <utility>

namespace antiradiance {

Inspection Inspector::inspect_now(Progress& progress) {
    const SolvedScene& solved = solution_->scene;
    if (options_.mode != InspectMode::kExplicitDifference)
        return inspect(solved, options_, nullptr, progress);
    StageInput input = *solved.input;
    input.options.visibility = Visibility::kExplicit;
    Report unread;
    const SolvedScene reference = explicit_.run(std::move(input), progress, unread);
    return inspect(solved, options_, &reference, progress);
}

Picture Inspector::draw(const std::shared_ptr<const LiveSolver::Solution>& solution,
                        const InspectOptions& options, const Camera& camera, int samples_per_axis,
                        Progress& progress) {
    if (solution != solution_ || options != options_) inspection_.reset();
    solution_ = solution;
    options_ = options;
    if (!inspection_) inspection_ = inspect_now(progress);
    return antiradiance::draw(solution->scene, *inspection_, camera, samples_per_axis, progress);
}

}  // namespace antiradiance
