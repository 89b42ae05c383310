// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/options.h"

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "base/error.h"
#include "prune/prune.h"

namespace antiradiance {

namespace {

// Reads and writes one member of Options; enums as their number.
template <auto Member>
OptionAccess access_to() {
    using Value = std::remove_reference_t<decltype(std::declval<Options>().*Member)>;
    if constexpr (std::is_enum_v<Value>) {
        return {[](const Options& o) -> OptionValue { return static_cast<int>(o.*Member); },
                [](Options& o, const OptionValue& v) {
                    o.*Member = static_cast<Value>(std::get<int>(v));
                }};
    } else {
        return {[](const Options& o) -> OptionValue { return o.*Member; },
                [](Options& o, const OptionValue& v) { o.*Member = std::get<Value>(v); }};
    }
}

// Mückl & Dachsbacher, section 4.2.
constexpr std::string_view kNot1Then2 =
    "heuristic 1 is not offered before heuristic 2: it removes the links to surfaces in between, "
    "in which heuristic 2 would see what blocks the others. Choose HEURISTIC_2_THEN_1";

std::vector<EnumItem> pruning_items() {
    std::vector<EnumItem> items{{"NONE", "None", "Keep all links"}};
    for (const PruneRule& rule : prune_rules())
        items.push_back({rule.identifier, rule.label, rule.description});
    return items;
}

bool tests_links_with_rays(const Options& options) {
    return options.visibility == Visibility::kExplicit || options.visibility == Visibility::kMixed;
}

bool mixes_visibility(const Options& options) {
    return options.visibility == Visibility::kMixed;
}

bool prunes_links(const Options& options) {
    return options.has_antiradiance();
}

// The evaluation has all rules, whatever the picture has.
bool runs_heuristic_1(const Options& options) {
    const bool has_it = options.pruning == PruneMethod::kHeuristic1 ||
                        options.pruning == PruneMethod::kHeuristic2Then1 ||
                        options.pruning == PruneMethod::kOracle1;
    return options.evaluate_pruning || (prunes_links(options) && has_it);
}

bool traces_shadow_rays(const Options& options) {
    return options.direct_light != DirectLightMode::kShadowMaps;
}

bool shoots(const Options& options) {
    return options.display == DisplayMode::kFinalShooting;
}

bool shoots_antiradiance(const Options& options) {
    return shoots(options) &&
           options.resolved_display().shooting_visibility == ShootingVisibility::kAntiradiance;
}

std::vector<OptionInfo> make_schema() {
    std::vector<OptionInfo> schema;
    schema.push_back(
        {.name = "visibility",
         .label = "Visibility",
         .tooltip = "How surfaces that block light between two patches are found",
         .type = OptionType::kEnum,
         .items = {{"IMPLICIT", "Implicit",
                    "Antiradiance: light passes through surfaces, which send the blocked light "
                    "onwards as negative light; no visibility test between patches"},
                   {"EXPLICIT", "Explicit",
                    "Hierarchical radiosity: every link is tested with rays; more accurate"},
                   {"MIXED", "Mixed",
                    "Rays where antiradiance carries most light, within Ray Budget; antiradiance "
                    "elsewhere"},
                   {"DISCRETE", "Discrete",
                    "Only the nearest patch in each direction is linked (Dong et al. 2007); for "
                    "comparisons, not for pictures"}},
         .access = access_to<&Options::visibility>()});
    schema.push_back(
        {.name = "direct_light",
         .label = "Direct Light",
         .tooltip = "How light reaches the first surface",
         .type = OptionType::kEnum,
         .items = {{"EXPLICIT", "Explicit",
                    "Lamps and emissive meshes by shadow rays; links carry the indirect light"},
                   {"IMPLICIT", "Implicit",
                    "Emissive meshes and area lamps emit along links as patches; point, spot and "
                    "sun lamps stay on shadow rays"},
                   {"SHADOW_MAPS", "Shadow Maps",
                    "As Explicit, but shadows are looked up in depth images that OpenGL draws; the "
                    "soft shadows of large lights have steps"}},
         .access = access_to<&Options::direct_light>()});
    schema.push_back(
        {.name = "direct_samples",
         .label = "Direct Samples",
         .tooltip = "Shadow rays for each light of a pixel; a pixel whose light is still uncertain "
                    "then gets up to 16 times as many",
         .type = OptionType::kInt,
         .min = 4,
         .max = 1024,
         .soft_min = 4,
         .soft_max = 128,
         .active = &traces_shadow_rays,
         .access = access_to<&Options::direct_samples>()});
    schema.push_back(
        {.name = "max_patch_size",
         .label = "Max Patch Size",
         .tooltip = "Longest edge of a patch before the links ask for smaller ones; 0 takes it "
                    "from the size of the scene",
         .type = OptionType::kFloat,
         .unit = OptionUnit::kLength,
         .min = 0,
         .max = 1000,
         .soft_min = 0,
         .soft_max = 5,
         .precision = 3,
         .access = access_to<&Options::max_patch_size>()});
    schema.push_back({.name = "link_threshold",
                      .label = "Link Threshold",
                      .tooltip =
                          "Largest form factor that one link may carry; smaller values make finer "
                          "patches, more links and less error",
                      .type = OptionType::kFloat,
                      .unit = OptionUnit::kFactor,
                      .min = 0.0005,
                      .max = 0.5,
                      .soft_min = 0.003,
                      .soft_max = 0.1,
                      .precision = 4,
                      .access = access_to<&Options::link_threshold>()});
    schema.push_back(
        {.name = "direction_bins",
         .label = "Direction Bins",
         .tooltip = "Number of directions that antiradiance is kept for; more of them only help "
                    "with a smaller link threshold",
         .type = OptionType::kInt,
         .min = 32,
         .max = 1024,
         .soft_min = 64,
         .soft_max = 512,
         .access = access_to<&Options::direction_bins>()});
    schema.push_back({.name = "visibility_rays",
                      .label = "Visibility Rays",
                      .tooltip = "Rays that test a link of average strength when Visibility is "
                                 "Explicit or Mixed; strong links get up to four times as many, "
                                 "weak ones a quarter",
                      .type = OptionType::kInt,
                      .min = 1,
                      .max = 64,
                      .soft_min = 1,
                      .soft_max = 16,
                      .active = &tests_links_with_rays,
                      .access = access_to<&Options::visibility_rays>()});
    schema.push_back({.name = "ray_budget",
                      .label = "Ray Budget",
                      .tooltip = "Share of the rays of Explicit visibility that Mixed may trace: 0 "
                                 "is Implicit, 1 is Explicit",
                      .type = OptionType::kFloat,
                      .unit = OptionUnit::kFactor,
                      .min = 0,
                      .max = 1,
                      .soft_min = 0,
                      .soft_max = 1,
                      .precision = 2,
                      .active = mixes_visibility,
                      .access = access_to<&Options::ray_budget>()});
    schema.push_back({.name = "pruning",
                      .label = "Pruning",
                      .tooltip =
                          "Which links are removed because surfaces block them, when Visibility is "
                          "Implicit or Mixed; rays have done so when it is Explicit",
                      .type = OptionType::kEnum,
                      .items = pruning_items(),
                      .refused = {{"HEURISTIC_1_THEN_2", kNot1Then2}},
                      .active = &prunes_links,
                      .access = access_to<&Options::pruning>()});
    schema.push_back(
        {.name = "pruning_directions",
         .label = "Pruning Directions",
         .tooltip = "What heuristic 1 takes for one direction",
         .type = OptionType::kEnum,
         .items = {{"STRICT", "Strict",
                    "All three links between source, occluder and receiver lie in one direction "
                    "bin, as the paper prints its algorithm"},
                   {"TEXT", "As in the text",
                    "The two links into the receiver lie in one bin, and the third in it or one "
                    "that touches it: finds more, and errs more"}},
         .active = &runs_heuristic_1,
         .access = access_to<&Options::pruning_directions>()});
    schema.push_back(
        {.name = "evaluate_pruning",
         .label = "Evaluate Pruning",
         .tooltip = "Compare what each pruning rule removes with rays, and its solution with one "
                    "whose links are tested with rays; slow. The table is in the report",
         .type = OptionType::kBool,
         .access = access_to<&Options::evaluate_pruning>()});
    schema.push_back(
        {.name = "remove_dark_links",
         .label = "Remove Dark Links",
         .tooltip = "Leave out links from patches that no light reaches, however often it bounces; "
                    "the solution is the same",
         .type = OptionType::kBool,
         .access = access_to<&Options::remove_dark_links>()});
    schema.push_back(
        {.name = "iterations",
         .label = "Iterations",
         .tooltip = "Passes over the links; 0 goes on until the light no longer changes, another "
                    "number runs that many passes of the paper's scheme",
         .type = OptionType::kInt,
         .min = 0,
         .max = 1000,
         .soft_min = 0,
         .soft_max = 32,
         .access = access_to<&Options::iterations>()});
    schema.push_back(
        {.name = "solver",
         .label = "Device",
         .tooltip = "Where the light transport, splatting and final shooting are computed",
         .type = OptionType::kEnum,
         .items = {{"AUTO", "Automatic", "OpenGL on a graphics card, else the processor"},
                   {"OPENGL", "OpenGL", "Compute shaders, on a graphics card or in software"},
                   {"CPU", "CPU", "The processor's cores"}},
         .access = access_to<&Options::solver>()});
    schema.push_back({.name = "display",
                      .label = "Display",
                      .tooltip = "How the solution becomes a picture",
                      .type = OptionType::kEnum,
                      .items = {{"PATCHES", "Patches",
                                 "One value of indirect light a patch, without interpolation; "
                                 "explicit direct light is computed per pixel"},
                                {"SPLATTING", "Splatting",
                                 "Patches blended into each other in image space; smooth, but "
                                 "without fine shadows"},
                                {"FINAL_SHOOTING", "Final Shooting",
                                 "Every pixel is lit by the patches as area lights, which gives "
                                 "smooth light and contact shadows"}},
                      .access = access_to<&Options::display>()});
    schema.push_back(
        {.name = "shooting_level",
         .label = "Shooting Level",
         .tooltip = "Which patches light the pixels in final shooting",
         .type = OptionType::kEnum,
         .items = {{"LEAVES", "Leaves", "Every patch at the finest level; slow"},
                   {"PARENTS", "Parents", "One level above the finest; a quarter of the patches"},
                   {"CUT", "Cut",
                    "Larger patches the farther they are, chosen for each tile of pixels"}},
         .active = &shoots,
         .access = access_to<&Options::shooting_level>()});
    schema.push_back(
        {.name = "shooting_visibility",
         .label = "Shooting Visibility",
         .tooltip = "What stops the light of a patch on its way to a pixel, in final shooting",
         .type = OptionType::kEnum,
         .items = {{"AUTO", "Automatic", "Antiradiance when Visibility is Implicit, else rays"},
                   {"ANTIRADIANCE", "Antiradiance",
                    "Patches in the way send what they block on behind them as negative light: no "
                    "rays, smooth, but wrong within a few centimetres behind a surface"},
                   {"RAYS", "Rays",
                    "Shadow rays to the patches, on the processor: contact shadows are exact"}},
         .active = &shoots,
         .access = access_to<&Options::shooting_visibility>()});
    schema.push_back({.name = "shooting_samples",
                      .label = "Shooting Samples",
                      .tooltip = "Points on each patch that lights a pixel, in final shooting",
                      .type = OptionType::kInt,
                      .min = 1,
                      .max = 16,
                      .soft_min = 1,
                      .soft_max = 16,
                      .active = &shoots,
                      .access = access_to<&Options::shooting_samples>()});
    schema.push_back({.name = "bin_map_size",
                      .label = "Bin Map Size",
                      .tooltip = "Resolution of the table that blends direction bins into each "
                                 "other when antiradiance is shot, along a face of its cube",
                      .type = OptionType::kInt,
                      .min = 32,
                      .max = 1024,
                      .soft_min = 64,
                      .soft_max = 512,
                      .active = &shoots_antiradiance,
                      .access = access_to<&Options::bin_map_size>()});
    schema.push_back(
        {.name = "interleave",
         .label = "Interleave",
         .tooltip = "Blocks of this many pixels squared share out the patches that light them, and "
                    "are blurred afterwards; 1 is exact, 4, 8 and 16 are faster and lose detail",
         .type = OptionType::kInt,
         .min = 1,
         .max = 16,
         .soft_min = 1,
         .soft_max = 16,
         .active = &shoots,
         .access = access_to<&Options::interleave>()});
    schema.push_back({.name = "report_path",
                      .label = "Report File",
                      .tooltip = "File that a JSON report is written to after each render, also "
                                 "after a failed one; empty for none",
                      .type = OptionType::kPath,
                      .access = access_to<&Options::report_path>()});
    return schema;
}

template <typename Range, typename Name>
std::string list_of(const Range& range, Name name) {
    std::string text;
    for (const auto& item : range)
        text += (text.empty() ? "" : ", ") + std::string(name(item));
    return text;
}

double number_of(const OptionValue& value) {
    if (const auto* i = std::get_if<int>(&value)) return *i;
    return std::get<float>(value);
}

[[noreturn]] void wrong_type(const OptionInfo& option, std::string_view wanted) {
    throw SceneError("Option '" + std::string(option.name) + "' takes " + std::string(wanted));
}

void set_enum(Options& options, const OptionInfo& option, const OptionValue& value) {
    const auto* id = std::get_if<std::string>(&value);
    if (!id) wrong_type(option, "the name of an item");
    const auto item = std::find_if(option.items.begin(), option.items.end(),
                                   [&](const EnumItem& i) { return i.id == *id; });
    if (item == option.items.end()) {
        if (const auto why = why_refused(option, *id); !why.empty())
            throw SceneError("Option '" + std::string(option.name) + "': " + std::string(why));
        throw SceneError("Option '" + std::string(option.name) + "' has no item '" + *id +
                         "'; choose one of " +
                         list_of(option.items, [](const EnumItem& i) { return i.id; }));
    }
    option.access.set(options, static_cast<int>(item - option.items.begin()));
}

void set_number(Options& options, const OptionInfo& option, const OptionValue& value) {
    const bool is_int = option.type == OptionType::kInt;
    if (!std::holds_alternative<int>(value) && (is_int || !std::holds_alternative<float>(value)))
        wrong_type(option, is_int ? "a whole number" : "a number");
    const double number = number_of(value);
    // A float may round just past a limit that is no binary fraction.
    const double slack = 1e-6 * std::max(1e-3, option.max);
    if (!(number >= option.min - slack && number <= option.max + slack)) {
        throw SceneError("Option '" + std::string(option.name) + "' must lie between " +
                         std::to_string(option.min) + " and " + std::to_string(option.max) +
                         ", not " + std::to_string(number));
    }
    if (is_int) {
        option.access.set(options, static_cast<int>(number));
    } else {
        option.access.set(options, static_cast<float>(number));
    }
}

auto find_option(std::string_view name) {
    const auto schema = option_schema();
    return std::find_if(schema.begin(), schema.end(),
                        [&](const OptionInfo& o) { return o.name == name; });
}

const EnumItem& set_item(const Options& options, std::string_view name) {
    const OptionInfo& option = *find_option(name);
    return option.items[static_cast<std::size_t>(std::get<int>(option.access.get(options)))];
}

}  // namespace

DisplayOptions Options::resolved_display() const {
    DisplayOptions result{display,      shooting_level, shooting_visibility, shooting_samples,
                          bin_map_size, interleave,     direct_samples};
    if (shooting_visibility == ShootingVisibility::kAuto) {
        result.shooting_visibility = visibility == Visibility::kImplicit
                                         ? ShootingVisibility::kAntiradiance
                                         : ShootingVisibility::kRays;
    }
    return result;
}

std::span<const OptionInfo> option_schema() {
    static const std::vector<OptionInfo> schema = make_schema();
    return schema;
}

std::string_view item_of(const Options& options, std::string_view name) {
    return set_item(options, name).id;
}

std::string_view label_of(const Options& options, std::string_view name) {
    return set_item(options, name).label;
}

std::string_view why_refused(const OptionInfo& option, std::string_view item) {
    const auto found = std::ranges::find(option.refused, item, &RefusedItem::id);
    return found == option.refused.end() ? std::string_view() : found->why;
}

void set_option(Options& options, std::string_view name, const OptionValue& value) {
    const auto schema = option_schema();
    const auto option = find_option(name);
    if (option == schema.end()) {
        throw SceneError("There is no option '" + std::string(name) + "'; the options are " +
                         list_of(schema, [](const OptionInfo& o) { return o.name; }));
    }
    switch (option->type) {
        case OptionType::kEnum:
            set_enum(options, *option, value);
            return;
        case OptionType::kInt:
        case OptionType::kFloat:
            set_number(options, *option, value);
            return;
        case OptionType::kPath:
            if (!std::holds_alternative<std::string>(value)) wrong_type(*option, "a file path");
            option->access.set(options, value);
            return;
        case OptionType::kBool:
            if (!std::holds_alternative<bool>(value)) wrong_type(*option, "true or false");
            option->access.set(options, value);
            return;
    }
}

}  // namespace antiradiance
