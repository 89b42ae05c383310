// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures that a viewport shows one after the other, from quick to good. A new level is a row
// of the list in picture_levels.cpp.
#pragma once

#include <string_view>
#include <vector>

#include "pipeline/options.h"
#include "pipeline/show.h"

namespace antiradiance {

enum class LevelName {
    kNavigation,   // a few a second: fewer pixels where they take too long
    kQuick,        // all pixels, light of patches
    kInterleaved,  // final shooting whose sources pixels share out
    kFinal,        // what a render makes
};
[[nodiscard]] std::string_view name_of(LevelName level);

struct PictureLevel {
    LevelName name;
    DisplayOptions options;
    PictureQuality quality;
};

// In their order, for what a render with these options shows in the end. What is inspected has no
// display options: its levels are two, and of their quality the samples alone count.
[[nodiscard]] std::vector<PictureLevel> picture_levels(const Options& options);
[[nodiscard]] std::vector<PictureLevel> inspection_levels();

// The camera with its pixels reduced to `share` of them along each side, at least one.
[[nodiscard]] Camera scaled(const Camera& camera, float share);

// How many pixels a navigation picture can have, from the time the last ones took.
class NavigationPace {
public:
    // Of the pixels along a side, 1/8..1, in 32nds: small changes of the pace do not show.
    [[nodiscard]] float share(double pixels) const;
    void add(double pixels, double seconds);

private:
    double seconds_per_pixel_ = 0;  // 0: unknown
};

}  // namespace antiradiance
