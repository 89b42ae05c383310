// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

namespace antiradiance {

// `antiradiance difference FIRST SECOND ...`, which runs when it is parsed. Throws SceneError.
void add_difference_command(CLI::App& app);

}  // namespace antiradiance
