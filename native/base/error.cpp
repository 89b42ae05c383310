// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"

namespace antiradiance {

namespace {
std::string join_lines(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) {
        if (!text.empty()) text += '\n';
        text += line;
    }
    return text;
}
}  // namespace

SceneError::SceneError(const std::vector<std::string>& problems)
    : std::runtime_error(join_lines(problems)) {}

}  // namespace antiradiance
