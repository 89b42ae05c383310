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

// What stops the light of a patch on its way to a fragment.
enum class ShootingVisibility {
    kAuto,          // rays where the links were tested with rays, else antiradiance
    kAntiradiance,  // what patches in the way send on behind them
    kRays,          // shadow rays
};

struct DisplayOptions {
    DisplayMode mode = DisplayMode::kFinalShooting;
    ShootingLevel shooting_level = ShootingLevel::kCut;
    ShootingVisibility shooting_visibility = ShootingVisibility::kRays;  // not kAuto
    int shooting_samples = 8;  // points on each patch light, 1..16
    int bin_map_size = 256;    // texels along a face of the cube map of bin weights, 32..1024
    int interleave = 1;        // n: every n x n pixels share out the sources, 1..16
    int direct_samples = 16;   // shadow rays for each light of a pixel, more where needed, 4..1024
    bool operator==(const DisplayOptions&) const = default;
};

}  // namespace antiradiance
