// SPDX-License-Identifier: GPL-3.0-or-later
// All settings of a picture at once, by a name: Blender's menu of presets, the command line's
// `--preset`.
#pragma once

#include <span>
#include <string_view>

#include "pipeline/options.h"

namespace antiradiance {

struct Preset {
    std::string_view id;  // as Blender and the command line spell it
    std::string_view label;
    std::string_view tooltip;  // Blender's style: starts with a capital, no full stop
    Options options;
};

// In display order, the best picture first.
std::span<const Preset> presets();

// Whether presets leave an option as it is: `solver` and `report_path` say where the work is done
// and told of, which is a matter of the machine and not of the picture.
bool kept_by_presets(std::string_view option);

// Sets all options but those that presets keep. Throws SceneError that lists the valid ids.
void apply_preset(Options& options, std::string_view id);

}  // namespace antiradiance
