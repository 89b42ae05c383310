// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "display/display_backend.h"

namespace antiradiance {

// 0: from the device's facts. Others are for tests, which reach every path with small scenes.
struct GlDisplayConfig {
    std::size_t block_bytes = 0;            // largest buffer
    std::uint32_t places_per_dispatch = 0;  // of each item's list
};

// Null, with the reason in `why_not`, where OpenGL 4.5 can't be had.
[[nodiscard]] std::unique_ptr<DisplayBackend> make_gl_display(const GlDisplayConfig& config,
                                                              std::string& why_not);

}  // namespace antiradiance
