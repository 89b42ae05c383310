// SPDX-License-Identifier: GPL-3.0-or-later
// Every setting of the engine, once: name, unit, range, default and tooltip. Blender's properties,
// the command line's flags and the JSON report are all made from `option_schema()`.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "display/display_options.h"
#include "links/link_options.h"
#include "prune/prune_options.h"
#include "solve/solve_options.h"

namespace antiradiance {

struct Options {
    Visibility visibility = Visibility::kExplicit;
    DirectLightMode direct_light = DirectLightMode::kExplicit;
    int direction_bins = 128;                  // 32..1024
    int iterations = 0;                        // 0: until the residual is below 1e-4
    float link_threshold = 0.02F;              // form factor, 0.0005..0.5
    float max_patch_size = 0;                  // m, longest edge; 0: from the scene's size
    int visibility_rays = 4;                   // per link of average transfer, 1..64
    float ray_budget = 0.25F;                  // of EXPLICIT's rays, in MIXED, 0..1
    PruneMethod pruning = PruneMethod::kNone;  // of links, in IMPLICIT and MIXED
    PruneDirections pruning_directions = PruneDirections::kStrict;  // of heuristic 1
    bool evaluate_pruning = false;   // of all rules, with each render
    bool remove_dark_links = false;  // those that carry nothing while the lights stay as they are
    SolverChoice solver = SolverChoice::kAuto;
    DisplayMode display = DisplayMode::kFinalShooting;
    ShootingLevel shooting_level = ShootingLevel::kCut;
    ShootingVisibility shooting_visibility = ShootingVisibility::kAuto;
    int shooting_samples = 8;  // points on each patch light, 1..16
    int bin_map_size = 256;    // texels along a face, 32..1024
    int interleave = 1;        // pixels along a side, 1..16
    int direct_samples = 16;   // shadow rays for each light of a pixel, 4..1024
    std::string report_path;   // empty: no report is written

    bool operator==(const Options&) const = default;

    // Whether light passes through surfaces and is taken back, at least in part: - links exist.
    [[nodiscard]] bool has_antiradiance() const {
        return visibility == Visibility::kImplicit || visibility == Visibility::kMixed;
    }
    // Of the display, with nothing left to choose.
    [[nodiscard]] DisplayOptions resolved_display() const;
};

struct EnumItem {
    std::string_view id;  // as Blender and the command line spell it
    std::string_view label;
    std::string_view tooltip;
};

// An item that one may look for, and why there is none.
struct RefusedItem {
    std::string_view id;
    std::string_view why;
};

enum class OptionType { kEnum, kInt, kFloat, kPath, kBool };
enum class OptionUnit { kNone, kLength, kFactor };

using OptionValue = std::variant<int, float, std::string, bool>;

// Reads and writes an option's member; enums as their index in `items`.
struct OptionAccess {
    OptionValue (*get)(const Options&);
    void (*set)(Options&, const OptionValue&);
};

struct OptionInfo {
    std::string_view name;
    std::string_view label;
    std::string_view tooltip;  // Blender's style: starts with a capital, no full stop
    OptionType type;
    OptionUnit unit = OptionUnit::kNone;
    double min = 0, max = 0;             // hard limits
    double soft_min = 0, soft_max = 0;   // of a slider
    int precision = 3;                   // digits behind the point, floats
    std::vector<EnumItem> items{};       // enums; an item's index is its value
    std::vector<RefusedItem> refused{};  // enums
    // Whether the option has an effect while the others are as they are.
    bool (*active)(const Options&) = [](const Options&) { return true; };
    OptionAccess access;
};

// In display order. Defaults are read from a default-constructed Options.
std::span<const OptionInfo> option_schema();

// The item that an enum option is set to: its id, and what artists see. `name` is in the schema.
std::string_view item_of(const Options& options, std::string_view name);
std::string_view label_of(const Options& options, std::string_view name);

// Why an item that an option has not got is refused; empty: for no reason of its own.
std::string_view why_refused(const OptionInfo& option, std::string_view item);

// Sets one option by name; enums by id. Throws SceneError that lists the valid names, ids or range.
void set_option(Options& options, std::string_view name, const OptionValue& value);

}  // namespace antiradiance
