// SPDX-License-Identifier: GPL-3.0-or-later
// Where two pictures of the same view differ, as in the paper's Fig. 7: red where the second is
// darker than the first, green where it is brighter, black where they are equal.
//
// The picture compares luminances as a display shows them, after the sRGB curve, because it answers
// where an eye would see a difference: as much of it in a shadow as in the light, and none beyond
// white. The figures are of the linear luminances, so that they compare with other tools' figures.
#pragma once

#include <span>

#include "display/display.h"

namespace antiradiance {

struct PictureView {
    int width = 0, height = 0;     // pixels
    std::span<const vec4> pixels;  // #pixels, linear Rec.709, premultiplied, row 0 below
};

struct Difference {
    Picture
        picture;  // `combined` only, opaque; shown as kDifferenceScale x the difference, up to 1
    // Linear luminance, over black where a picture is transparent:
    double mean_first = 0, mean_second = 0;
    double relative_rms = 0;  // RMS of second - first over mean_first; infinite if that is 0
    double largest = 0;       // of |second - first|
};

inline constexpr float kDifferenceScale = 4;

// Throws SceneError when the sizes differ, or pixels are no finite numbers.
[[nodiscard]] Difference luminance_difference(const PictureView& first, const PictureView& second);

}  // namespace antiradiance
