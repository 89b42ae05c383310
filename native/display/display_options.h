// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace antiradiance {

enum class DisplayMode {
    kPatches,        // one irradiance a patch ("no interpolation" in the paper)
    kSplatting,      // patches blended in image space (Dachsbacher et al. 2007)
    kFinalShooting,  // every pixel is lit by the patches as area lights (the paper's section 5)
};

// Which nodes of the hierarchy shoot.
enum class ShootingLevel {
    kLeaves,
    kParents,  // of leaves
    kCut,      // chosen for each tile of pixels by size and distance
};

struct DisplayOptions {
    DisplayMode mode = DisplayMode::kPatches;
    ShootingLevel shooting_level = ShootingLevel::kCut;
    int shooting_samples = 8;  // points on each patch light, 1..16
    int interleave = 1;        // n: every n x n pixels share out the sources, 1..16
    bool operator==(const DisplayOptions&) const = default;
};

}  // namespace antiradiance
