// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/evaluate_rules.h"

namespace antiradiance {

// {METHOD: {explicit, removed, incorrect, incorrect_radiance, not_removed, seconds, solution:
// {relative_rms, bias, largest_leak, converged}}}, a key for each rule. Other tools read these
// keys.
[[nodiscard]] nlohmann::ordered_json json_of(const std::vector<RuleEvaluation>& rules);
[[nodiscard]] nlohmann::ordered_json json_of(const SolutionError& error);

}  // namespace antiradiance
