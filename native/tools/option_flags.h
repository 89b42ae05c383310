// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include "pipeline/options.h"

namespace antiradiance {

// One flag for every row of option_schema(): `--link-threshold 0.01` sets `link_threshold`. And
// `--preset` for the values that the flags start from.
void add_option_flags(CLI::App& command, Options& options);

}  // namespace antiradiance
