// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/presets.h"

#include <gtest/gtest.h>

#include <cctype>
#include <set>
#include <string>

#include "base/error.h"

namespace antiradiance {
namespace {

Options of_preset(std::string_view id) {
    Options options;
    apply_preset(options, id);
    return options;
}

// As Blender and the command line give it: enums by their ids.
OptionValue by_name(const OptionInfo& option, const Options& options) {
    if (option.type == OptionType::kEnum) return std::string(item_of(options, option.name));
    return option.access.get(options);
}

TEST(Presets, HaveLabelsAndTooltipsOfTheirOwn) {
    std::set<std::string> ids;
    std::set<std::string> labels;
    for (const Preset& preset : presets()) {
        EXPECT_TRUE(ids.emplace(preset.id).second) << preset.id;
        EXPECT_TRUE(labels.emplace(preset.label).second) << preset.label;
        ASSERT_FALSE(preset.tooltip.empty()) << preset.id;
        EXPECT_TRUE(std::isupper(preset.tooltip.front())) << preset.id;
        EXPECT_NE(preset.tooltip.back(), '.') << preset.id << ": Blender adds the full stop";
    }
    EXPECT_EQ(ids, std::set<std::string>({"FINAL", "PREVIEW", "PAPER"}));
}

TEST(Presets, HoldOnlyValuesThatCanBeSet) {
    for (const Preset& preset : presets()) {
        Options options;
        for (const OptionInfo& option : option_schema())
            set_option(options, option.name, by_name(option, preset.options));
        EXPECT_EQ(options, preset.options) << preset.id;
    }
}

TEST(Presets, DifferInWhatHasAnEffect) {
    for (const Preset& preset : presets()) {
        for (const OptionInfo& option : option_schema()) {
            if (option.access.get(preset.options) != option.access.get(Options{})) {
                EXPECT_TRUE(option.active(preset.options)) << preset.id << ": " << option.name;
            }
        }
    }
}

TEST(Presets, FinalIsTheDefault) {
    EXPECT_EQ(presets().front().id, "FINAL");
    EXPECT_EQ(of_preset("FINAL"), Options());
}

TEST(Presets, PaperIsWhatThePaperSays) {
    const Options o = of_preset("PAPER");
    EXPECT_EQ(o.visibility, Visibility::kImplicit);
    EXPECT_EQ(o.direct_light, DirectLightMode::kShadowMaps);
    EXPECT_EQ(o.direction_bins, 128);
    EXPECT_EQ(o.iterations, 4);
    EXPECT_EQ(o.pruning, PruneMethod::kHeuristic2Then1);
    EXPECT_EQ(o.pruning_directions, PruneDirections::kStrict);
    EXPECT_EQ(o.display, DisplayMode::kFinalShooting);
    EXPECT_EQ(o.shooting_level, ShootingLevel::kLeaves);
    EXPECT_EQ(o.resolved_display().shooting_visibility, ShootingVisibility::kAntiradiance);
    EXPECT_EQ(o.shooting_samples, 8);
    EXPECT_EQ(o.bin_map_size, 512);
    EXPECT_EQ(o.interleave, 1);
}

TEST(Presets, KeepTheDeviceAndTheReportOnly) {
    for (const Preset& preset : presets()) {
        Options options;
        for (const OptionInfo& option : option_schema()) {
            if (option.type == OptionType::kEnum) {
                set_option(options, option.name, std::string(option.items.back().id));
            } else if (option.type == OptionType::kInt) {
                set_option(options, option.name, static_cast<int>(option.max));
            } else if (option.type == OptionType::kFloat) {
                set_option(options, option.name, static_cast<float>(option.max));
            } else if (option.type == OptionType::kBool) {
                set_option(options, option.name, true);
            }
        }
        options.solver = SolverChoice::kCpu;
        options.report_path = "report.json";
        apply_preset(options, preset.id);
        Options wanted = preset.options;
        wanted.solver = SolverChoice::kCpu;
        wanted.report_path = "report.json";
        EXPECT_EQ(options, wanted) << preset.id;
    }
}

TEST(Presets, UnknownIdsListTheValidOnes) {
    Options options;
    options.iterations = 7;
    const Options before = options;
    try {
        apply_preset(options, "papre");
        FAIL() << "no preset has this id";
    } catch (const SceneError& e) {
        const std::string error = e.what();
        EXPECT_NE(error.find("'papre'"), std::string::npos) << error;
        for (const Preset& preset : presets())
            EXPECT_NE(error.find(preset.id), std::string::npos) << error;
    }
    EXPECT_EQ(options, before);
}

}  // namespace
}  // namespace antiradiance
