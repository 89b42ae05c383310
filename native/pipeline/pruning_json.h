// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/evaluate_rules.h"

namespace antiradiance {

// {patches, links, explicit, explicit_seconds, unpruned: SOLUTION, evaluation: {METHOD: {explicit,
// removed, incorrect, incorrect_radiance, not_removed, seconds, solution: SOLUTION}}}, a METHOD for
// each rule; SOLUTION: {relative_rms, bias, largest_leak, converged}. Other tools read these keys.
[[nodiscard]] nlohmann::ordered_json json_of(const PruningTable& table);

}  // namespace antiradiance
