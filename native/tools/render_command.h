// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

namespace antiradiance {

// `antiradiance render SCENE.obj ...`, which runs when it is parsed. Throws what Session throws.
void add_render_command(CLI::App& app);

}  // namespace antiradiance
