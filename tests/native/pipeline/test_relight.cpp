// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/relight.h"

#include <gtest/gtest.h>

#include <functional>

#include "pipeline/stages.h"
#include "relative_rms.h"
#include "support/scene_builder.h"
#include "support/scenes.h"

namespace antiradiance {
namespace {

using test::relative_rms;

constexpr int kPanel = 1;  // the material of the office's luminous panel

StageInput office() {
    StageInput input;
    input.scene = test::office();
    test::add_point_lamp(input.scene, vec3(1, 2, 2), vec3(20, 20, 0));
    input.options.max_patch_size = 1;
    input.options.solver = SolverChoice::kCpu;
    return input;
}

StageInput with(const std::function<void(StageInput&)>& edit) {
    StageInput input = office();
    edit(input);
    return input;
}

SolvedScene solve(Stages& stages, const StageInput& input) {
    Progress progress;
    Report report;
    return stages.run(input, progress, report);
}

SolvedScene solve(const StageInput& input) {
    Stages stages;
    return solve(stages, input);
}

const auto dim_the_lamp = [](StageInput& i) { i.scene.lamps[0].power *= vec3(0.3F, 1, 1); };
const auto brighten_the_panel = [](StageInput& i) { i.scene.materials[kPanel].emission *= 3.0F; };

TEST(Relight, FindsWhatShadowRaysFind) {
    const SolvedScene solved = solve(office());
    const StageInput edited = with([](StageInput& i) {
        dim_the_lamp(i);
        brighten_the_panel(i);
    });
    const auto relit = relight(solved, edited);
    ASSERT_TRUE(relit);
    const SolvedScene fresh = solve(edited);
    // Shadow rays end at a standard error of a hundredth.
    EXPECT_LT(relative_rms(*relit, *fresh.leaf_direct), 0.01);
    EXPECT_GT(relative_rms(*relit, *solved.leaf_direct), 0.3) << "or nothing was edited";
}

TEST(Relight, LeavesTheRestToOthers) {
    const SolvedScene solved = solve(office());
    EXPECT_TRUE(relight(solved, office()));
    EXPECT_TRUE(relight(solved, with([](StageInput& i) { i.scene.materials[2].albedo *= 0.5F; })));
    const auto edits = std::to_array<std::function<void(StageInput&)>>(
        {[](StageInput& i) { i.scene.lamps[0].to_world[3].x += 0.1F; },
         [](StageInput& i) { i.scene.lamps[0].power.z = 1; },      // it had no blue to scale
         [](StageInput& i) { i.scene.lamps[0].power = vec3(0); },  // other surfaces may be lit
         [](StageInput& i) { i.scene.positions[0].x += 0.1F; },
         [](StageInput& i) { i.scene.lamps.pop_back(); },
         [](StageInput& i) { i.options.direct_light = DirectLightMode::kImplicit; }});
    for (std::size_t i = 0; i < edits.size(); ++i)
        EXPECT_FALSE(relight(solved, with(edits[i]))) << i;
}

TEST(Relight, TheRestOfTheSolutionFollows) {
    for (const Visibility visibility : {Visibility::kExplicit, Visibility::kImplicit}) {
        StageInput input = office();
        input.options.visibility = visibility;
        Stages stages;
        const SolvedScene before = solve(stages, input);
        brighten_the_panel(input);
        Progress progress;
        Report report;
        const auto relit = stages.run_relit(input, progress, report);
        ASSERT_TRUE(relit);
        EXPECT_EQ(relit->model, before.model);
        EXPECT_EQ(report.timings_s.direct, 0);
        const SolvedScene fresh = solve(input);
        EXPECT_LT(relative_rms(relit->light->irradiance, fresh.light->irradiance), 0.005)
            << "the noise of direct light, averaged by reflection";
        // What was kept is that of the run before.
        EXPECT_EQ(solve(stages, input).leaf_direct->at(0), fresh.leaf_direct->at(0));
    }
}

TEST(Relight, NothingWasSolvedBefore) {
    Progress progress;
    Report report;
    EXPECT_FALSE(Stages().run_relit(office(), progress, report));
}

}  // namespace
}  // namespace antiradiance
