// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace antiradiance {

enum class DisplayMode {
    kPatches,  // one irradiance a patch ("no interpolation" in the paper)
};

}  // namespace antiradiance
