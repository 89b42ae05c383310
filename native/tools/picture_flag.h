// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace antiradiance {

// `-o PICTURE`, .exr or .png. otherwise: what the command does without it.
void add_picture_flag(CLI::App& command, std::string& path, const std::string& otherwise);

}  // namespace antiradiance
