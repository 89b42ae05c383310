// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "pipeline/solved_scene.h"
#include "pipeline/stage_input.h"

namespace antiradiance {

// Direct light of the leaves (#nodes, W/m2) when nothing up to and including it differs from
// `solved` but the strength and colour of lights: light adds up, so each light's share is scaled.
// Equal to what shadow rays would find up to their noise, a hundredth. None: something else
// differs, a light had none of a colour that it has now, or there are no shares to scale.
[[nodiscard]] std::optional<std::vector<vec3>> relight(const SolvedScene& solved,
                                                       const StageInput& input);

}  // namespace antiradiance
