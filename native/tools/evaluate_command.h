// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

namespace antiradiance {

// `antiradiance evaluate SCENE.obj ...`, which runs when it is parsed. Throws what evaluate_rules()
// throws.
void add_evaluate_command(CLI::App& app);

}  // namespace antiradiance
