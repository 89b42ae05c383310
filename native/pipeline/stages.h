// SPDX-License-Identifier: GPL-3.0-or-later
// The stages from a scene to its light: a chain, each of which reads what those before it made.
// What they made is kept, and a stage is run again only when its input has changed or one before it
// has run.
//
// A new stage is a row of the table in stages.cpp; what it reads is listed in stage_input.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/progress.h"
#include "pipeline/report.h"
#include "pipeline/solved_scene.h"
#include "pipeline/stage_input.h"

namespace antiradiance {

class Stages {
public:
    static constexpr std::size_t kCount = 6;

    Stages();

    // What rays found in an earlier state of the scene, to hold where nothing has changed since.
    struct Reuse {
        bool keep = false;                     // what the next run can reuse, at 12 bytes a pair
        const SolvedScene* earlier = nullptr;  // all of its stages have run; null: nothing is known
    };

    // Runs what `input` asks for. What a stage before had made of older input is freed first,
    // unless a SolvedScene that was returned before still has it.
    // Writes each stage's figures, warnings and whether it ran into `report`, as far as it gets.
    // Throws what the stages throw; those that were done by then are kept.
    SolvedScene run(StageInput input, Progress& progress, Report& report, const Reuse& reuse);
    SolvedScene run(StageInput input, Progress& progress, Report& report) {
        return run(std::move(input), progress, report, {});
    }

    // What run() would return, but with direct light that follows from the last run's (relight()):
    // the strength of lights alone has changed, and no shadow ray is traced. None: more has
    // changed. Keeps nothing. Pictures of it are right where pixels have the direct light of
    // leaves.
    [[nodiscard]] std::optional<SolvedScene> run_relit(StageInput input, Progress& progress,
                                                       Report& report) const;

    // How long run() is going to take: the stages that it has to run took this long when they last
    // ran. s; infinity where one never ran to its end.
    [[nodiscard]] double expected_seconds(const StageInput& input) const;

private:
    [[nodiscard]] std::size_t first_changed(const StageInput& input) const;

    SolvedScene solved_;                  // of the last run, as far as its stages have come
    std::size_t done_ = 0;                // stages whose results in solved_ fit its input
    std::array<double, kCount> seconds_;  // that each took when it last ran to its end
};

}  // namespace antiradiance
