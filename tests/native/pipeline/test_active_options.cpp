// SPDX-License-Identifier: GPL-3.0-or-later
// OptionInfo::active: which options have an effect, and that the others have none.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "pipeline/session.h"
#include "support/scene_builder.h"
#include "support/scenes.h"

namespace antiradiance {
namespace {

std::set<std::string> inactive(const Options& options) {
    std::set<std::string> names;
    for (const OptionInfo& option : option_schema()) {
        if (!option.active(options)) names.emplace(option.name);
    }
    return names;
}

Options quick() {
    Options options;
    options.max_patch_size = 2;
    options.link_threshold = 0.1F;
    options.solver = SolverChoice::kCpu;
    return options;
}

struct Case {
    std::string name;
    Options options;
    std::set<std::string> inactive;
};

std::vector<Case> cases() {
    std::vector<Case> result;
    const auto add = [&](std::string name, auto edit, std::set<std::string> inactive) {
        Options options = quick();
        edit(options);
        result.push_back({std::move(name), options, std::move(inactive)});
    };
    add("explicit", [](Options&) {},
        {"ray_budget", "pruning", "pruning_directions", "bin_map_size"});
    add("explicit, antiradiance is shot",
        [](Options& o) { o.shooting_visibility = ShootingVisibility::kAntiradiance; },
        {"ray_budget", "pruning", "pruning_directions"});
    add("patches",
        [](Options& o) {
            o.visibility = Visibility::kImplicit;
            o.display = DisplayMode::kPatches;
            o.shooting_visibility = ShootingVisibility::kAntiradiance;
        },
        {"visibility_rays", "ray_budget", "pruning_directions", "shooting_level",
         "shooting_visibility", "shooting_samples", "bin_map_size", "interleave"});
    add("implicit, rays are shot",
        [](Options& o) {
            o.visibility = Visibility::kImplicit;
            o.pruning = PruneMethod::kHeuristic2;
            o.shooting_visibility = ShootingVisibility::kRays;
        },
        {"visibility_rays", "ray_budget", "pruning_directions", "bin_map_size"});
    add("implicit, heuristic 1",
        [](Options& o) {
            o.visibility = Visibility::kImplicit;
            o.pruning = PruneMethod::kHeuristic2Then1;
        },
        {"visibility_rays", "ray_budget"});
    add("mixed",
        [](Options& o) {
            o.visibility = Visibility::kMixed;
            o.pruning = PruneMethod::kHeuristic1;
        },
        {"bin_map_size"});
    add("discrete", [](Options& o) { o.visibility = Visibility::kDiscrete; },
        {"visibility_rays", "ray_budget", "pruning", "pruning_directions", "bin_map_size"});
    return result;
}

Scene office() {
    Scene scene = test::office();
    test::add_point_lamp(scene, vec3(1, 2, 2), vec3(20));
    test::add_office_camera(scene, 16, 12);
    return scene;
}

std::vector<vec4> picture(const Scene& scene, const Options& options) {
    Progress progress;
    return Session().render(scene, options, false, 0, progress).picture.combined;
}

// Another value that is valid.
void change(Options& options, const OptionInfo& option) {
    const OptionValue value = option.access.get(options);
    if (const auto* i = std::get_if<int>(&value)) {
        const int last = option.type == OptionType::kEnum
                             ? static_cast<int>(option.items.size()) - 1
                             : static_cast<int>(option.soft_max);
        option.access.set(options, *i == last ? *i - 1 : last);
    } else if (const auto* f = std::get_if<float>(&value)) {
        const auto last = static_cast<float>(option.soft_max);
        option.access.set(options, *f == last ? static_cast<float>(option.soft_min) : last);
    } else {
        FAIL() << option.name << ": how to change it is to be said here";
    }
}

TEST(ActiveOptions, AreThoseThatTheModesAskFor) {
    for (const Case& c : cases())
        EXPECT_EQ(inactive(c.options), c.inactive) << c.name;
}

TEST(ActiveOptions, OthersChangeNothing) {
    const Scene scene = office();
    for (const Case& c : cases()) {
        const std::vector<vec4> wanted = picture(scene, c.options);
        for (const OptionInfo& option : option_schema()) {
            if (option.active(c.options)) continue;
            Options options = c.options;
            change(options, option);
            ASSERT_NE(options, c.options) << option.name;
            EXPECT_EQ(picture(scene, options), wanted) << c.name << ": " << option.name;
        }
    }
}

TEST(ActiveOptions, ShadowMapsTakeNoDirectSamples) {
    Options options;
    EXPECT_FALSE(inactive(options).contains("direct_samples"));
    options.direct_light = DirectLightMode::kShadowMaps;
    EXPECT_TRUE(inactive(options).contains("direct_samples"));
}

TEST(ActiveOptions, TheEvaluationRunsHeuristic1WhateverThePictureHas) {
    Options options;
    options.evaluate_pruning = true;
    EXPECT_FALSE(inactive(options).contains("pruning_directions"));
}

}  // namespace
}  // namespace antiradiance
