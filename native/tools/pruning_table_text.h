// SPDX-License-Identifier: GPL-3.0-or-later
// A PruningTable for people, spreadsheets and programs.
#pragma once

#include <string>

#include "pipeline/evaluate_rules.h"

namespace antiradiance {

// Columns, in the paper's order: patches, links, links that rays do not get through, then what each
// rule removes, removes wrongly (and of that the + links), leaves of what it should remove, its
// seconds, and the relative RMS error, bias and largest leak of the solution that is left. The
// first row is of no pruning.
[[nodiscard]] std::string to_text(const PruningTable& table);
[[nodiscard]] std::string to_csv(const PruningTable& table);
[[nodiscard]] std::string to_json(const PruningTable& table);

}  // namespace antiradiance
