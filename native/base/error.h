// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace antiradiance {

// Input that can't be rendered. The text names the Blender object and says what to do about it;
// several problems are reported together, one a line.
class SceneError : public std::runtime_error {
public:
    explicit SceneError(const std::string& problem) : std::runtime_error(problem) {}
    explicit SceneError(const std::vector<std::string>& problems);
};

// Thrown out of a stage when the caller asked to stop; it is no error.
class Cancelled : public std::exception {
public:
    [[nodiscard]] const char* what() const noexcept override { return "cancelled"; }
};

}  // namespace antiradiance
