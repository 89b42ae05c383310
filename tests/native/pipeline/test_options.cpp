// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/options.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "base/error.h"

namespace antiradiance {
namespace {

std::string error_of(std::string_view name, const OptionValue& value) {
    Options options;
    try {
        set_option(options, name, value);
    } catch (const SceneError& e) {
        EXPECT_EQ(options, Options()) << "a refused value must change nothing";
        return e.what();
    }
    return "";
}

TEST(Options, DefaultsAreThoseOfTheManual) {
    const Options o;
    EXPECT_EQ(o.visibility, Visibility::kExplicit);
    EXPECT_EQ(o.direct_light, DirectLightMode::kExplicit);
    EXPECT_EQ(o.direction_bins, 128);
    EXPECT_EQ(o.iterations, 0);
    EXPECT_EQ(o.link_threshold, 0.02F);
    EXPECT_EQ(o.max_patch_size, 0);
    EXPECT_EQ(o.visibility_rays, 4);
    EXPECT_EQ(o.ray_budget, 0.25F);
    EXPECT_EQ(o.solver, SolverChoice::kAuto);
    EXPECT_EQ(o.display, DisplayMode::kFinalShooting);
    EXPECT_EQ(o.direct_samples, 16);
    EXPECT_EQ(o.report_path, "");
}

TEST(Options, SchemaHoldsEveryOptionOnce) {
    std::set<std::string> names;
    for (const OptionInfo& o : option_schema()) {
        EXPECT_TRUE(names.emplace(o.name).second) << o.name;
        EXPECT_FALSE(o.label.empty()) << o.name;
        ASSERT_FALSE(o.tooltip.empty()) << o.name;
        EXPECT_TRUE(std::isupper(o.tooltip.front())) << o.name;
        EXPECT_NE(o.tooltip.back(), '.') << o.name << ": Blender adds the full stop";
        EXPECT_EQ(o.type == OptionType::kEnum, !o.items.empty()) << o.name;
    }
    EXPECT_EQ(names, std::set<std::string>({"visibility",       "direct_light",
                                            "direction_bins",   "iterations",
                                            "link_threshold",   "max_patch_size",
                                            "visibility_rays",  "ray_budget",
                                            "pruning",          "pruning_directions",
                                            "evaluate_pruning", "remove_dark_links",
                                            "solver",           "display",
                                            "shooting_level",   "shooting_visibility",
                                            "shooting_samples", "bin_map_size",
                                            "interleave",       "direct_samples",
                                            "report_path"}));
}

TEST(Options, Heuristic1BeforeHeuristic2IsRefusedWithTheReason) {
    const std::string error = error_of("pruning", std::string("HEURISTIC_1_THEN_2"));
    EXPECT_NE(error.find("would see what blocks the others"), std::string::npos) << error;
    EXPECT_NE(error.find("HEURISTIC_2_THEN_1"), std::string::npos) << error;
}

TEST(Options, DefaultsLieWithinTheirLimits) {
    const Options options;
    for (const OptionInfo& o : option_schema()) {
        const OptionValue value = o.access.get(options);
        if (o.type == OptionType::kInt || o.type == OptionType::kFloat) {
            const double number =
                o.type == OptionType::kInt ? std::get<int>(value) : double{std::get<float>(value)};
            EXPECT_LE(o.min, o.soft_min) << o.name;
            EXPECT_LE(o.soft_max, o.max) << o.name;
            EXPECT_GE(number, o.soft_min - 1e-6) << o.name;
            EXPECT_LE(number, o.soft_max) << o.name;
        } else if (o.type == OptionType::kEnum) {
            EXPECT_LT(static_cast<std::size_t>(std::get<int>(value)), o.items.size()) << o.name;
        }
    }
}

TEST(Options, EveryItemAndBothLimitsCanBeSet) {
    for (const OptionInfo& o : option_schema()) {
        Options options;
        for (std::size_t i = 0; i < o.items.size(); ++i) {
            set_option(options, o.name, std::string(o.items[i].id));
            EXPECT_EQ(std::get<int>(o.access.get(options)), static_cast<int>(i)) << o.name;
        }
        for (const double limit : {o.min, o.max}) {
            if (o.type == OptionType::kInt) {
                set_option(options, o.name, static_cast<int>(limit));
                EXPECT_EQ(std::get<int>(o.access.get(options)), static_cast<int>(limit)) << o.name;
            } else if (o.type == OptionType::kFloat) {
                set_option(options, o.name, static_cast<float>(limit));
                EXPECT_EQ(std::get<float>(o.access.get(options)), static_cast<float>(limit));
            }
        }
    }
    Options options;
    set_option(options, "max_patch_size", 2);  // a whole number is a number
    EXPECT_EQ(options.max_patch_size, 2);
    set_option(options, "report_path", std::string("report.json"));
    EXPECT_EQ(options.report_path, "report.json");
}

TEST(Options, ValuesBeyondTheLimitsAreRefusedWithTheRange) {
    for (const OptionInfo& o : option_schema()) {
        if (o.type == OptionType::kInt) {
            for (const int value : {static_cast<int>(o.min) - 1, static_cast<int>(o.max) + 1}) {
                const std::string error = error_of(o.name, value);
                EXPECT_NE(error.find(o.name), std::string::npos) << error;
                EXPECT_NE(error.find(std::to_string(o.min)), std::string::npos) << error;
                EXPECT_NE(error.find(std::to_string(o.max)), std::string::npos) << error;
            }
        } else if (o.type == OptionType::kFloat) {
            EXPECT_NE(error_of(o.name, static_cast<float>(o.max * 1.1)), "");
            EXPECT_NE(error_of(o.name, -1.0F), "");
            EXPECT_NE(error_of(o.name, std::nanf("")), "") << o.name;
        }
    }
}

TEST(Options, UnknownNamesListTheValidOnes) {
    const std::string option = error_of("visibilty", std::string("EXPLICIT"));
    EXPECT_NE(option.find("'visibilty'"), std::string::npos) << option;
    for (const OptionInfo& o : option_schema())
        EXPECT_NE(option.find(o.name), std::string::npos) << option;

    for (const OptionInfo& o : option_schema()) {
        if (o.type != OptionType::kEnum) continue;
        const std::string item = error_of(o.name, std::string("MAYBE"));
        for (const EnumItem& i : o.items)
            EXPECT_NE(item.find(i.id), std::string::npos) << item;
    }
}

TEST(Options, WrongTypesAreRefused) {
    EXPECT_NE(error_of("visibility", 1), "");
    EXPECT_NE(error_of("direction_bins", 64.5F), "");
    EXPECT_NE(error_of("direction_bins", std::string("64")), "");
    EXPECT_NE(error_of("link_threshold", true), "");
    EXPECT_NE(error_of("report_path", 3), "");
}

}  // namespace
}  // namespace antiradiance
