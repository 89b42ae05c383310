// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/presets.h"

#include <algorithm>
#include <string>
#include <vector>

#include "base/error.h"

namespace antiradiance {

namespace {

// In rooms of 100 x 75 pixels a seventh (office) to a ninth (Japanese-style room) of the default's
// processor time, and .04 away from its picture (relative RMS over 4 x 4 blocks). A patch size that
// goes with the scene's would be finer than this in rooms, coarser beyond 5,000 m2 of surface.
Options preview() {
    Options options;
    options.max_patch_size = 1;
    options.link_threshold = 0.05F;
    options.visibility_rays = 1;
    options.direct_samples = 4;
    options.display = DisplayMode::kSplatting;
    return options;
}

// Mückl & Dachsbacher, "Deducing Explicit from Implicit Visibility for Global Illumination with
// Antiradiance". The paper says nothing of the sizes of patches and links: they are the defaults.
Options paper() {
    Options options;
    options.visibility = Visibility::kImplicit;           // section 3, equations 3 and 4
    options.direct_light = DirectLightMode::kShadowMaps;  // section 4.2, the last paragraph
    options.direction_bins = 128;                         // section 6.2
    options.iterations = 4;                               // section 6.2, figure 9; figure 8 takes 6
    options.pruning = PruneMethod::kHeuristic2Then1;      // section 6.1; 1 before 2 errs: 4.2
    options.pruning_directions = PruneDirections::kStrict;  // algorithm 1, lines 16 and 17
    options.display = DisplayMode::kFinalShooting;          // section 5
    options.shooting_level = ShootingLevel::kLeaves;        // section 6.2; figure 11 has PARENTS
    options.shooting_visibility = ShootingVisibility::kAntiradiance;  // section 5
    options.shooting_samples = 8;                                     // section 5
    options.bin_map_size = 512;                                       // section 5
    options.interleave = 1;  // section 5 interleaves where no link is removed
    return options;
}

}  // namespace

std::span<const Preset> presets() {
    static const std::vector<Preset> table = {
        {"FINAL", "Final",
         "The defaults: links and pixels tested with rays, the closest to the truth", Options{}},
        {"PREVIEW", "Preview",
         "A quick look: patches of a metre, blended into each other, and grainier shadows",
         preview()},
        {"PAPER", "Paper",
         "As Mückl and Dachsbacher describe it: antiradiance in four passes over links pruned by "
         "heuristic 2, then 1, direct light by shadow maps, and all patches shot at the pixels",
         paper()},
    };
    return table;
}

bool kept_by_presets(std::string_view option) {
    return option == "solver" || option == "report_path";
}

void apply_preset(Options& options, std::string_view id) {
    const auto table = presets();
    const auto preset = std::ranges::find(table, id, &Preset::id);
    if (preset == table.end()) {
        std::string ids;
        for (const Preset& p : table)
            ids += (ids.empty() ? "" : ", ") + std::string(p.id);
        throw SceneError("There is no preset '" + std::string(id) + "'; the presets are " + ids);
    }
    for (const OptionInfo& option : option_schema()) {
        if (!kept_by_presets(option.name))
            option.access.set(options, option.access.get(preset->options));
    }
}

}  // namespace antiradiance
