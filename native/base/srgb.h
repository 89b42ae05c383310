// SPDX-License-Identifier: GPL-3.0-or-later
// The sRGB transfer curve (IEC 61966-2-1): linear light <-> what a display is sent, both 0..1.
#pragma once

#include <algorithm>
#include <cmath>

namespace antiradiance {

inline float encode_srgb(float linear) {
    const float x = std::clamp(linear, 0.0F, 1.0F);
    return x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
}

inline float decode_srgb(float encoded) {
    const float x = std::clamp(encoded, 0.0F, 1.0F);
    return x <= 0.04045F ? x / 12.92F : std::pow((x + 0.055F) / 1.055F, 2.4F);
}

}  // namespace antiradiance
