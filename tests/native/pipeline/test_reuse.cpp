// SPDX-License-Identifier: GPL-3.0-or-later
// What rays found in an earlier state of a scene: kept where nothing has moved, and nowhere else.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <utility>

#include "pipeline/stages.h"
#include "relative_rms.h"
#include "support/scene_builder.h"
#include "support/scenes.h"

namespace antiradiance {
namespace {

using test::relative_rms;

// The office with a box that stands free, in the light of a lamp and of its luminous panel.
StageInput office(const vec3& box) {
    StageInput input;
    input.scene = test::office();
    test::add_point_lamp(input.scene, vec3(1, 2, 2), vec3(20));
    test::add_box(input.scene, "box", box, box + vec3(0.6F, 0.6F, 1), 0);
    input.options.max_patch_size = 0.5F;
    input.options.solver = SolverChoice::kCpu;
    return input;
}

const vec3 kHere(1, 2.4F, 0.1F);
const vec3 kThere(1.9F, 2.6F, 0.3F);

SolvedScene solve(const StageInput& input, const SolvedScene* earlier = nullptr) {
    Stages stages;
    Progress progress;
    Report report;
    return stages.run(input, progress, report, {.keep = true, .earlier = earlier});
}

TEST(Reuse, AMovedObjectGetsTheLightOfARebuild) {
    const SolvedScene earlier = solve(office(kHere));
    const SolvedScene reused = solve(office(kThere), &earlier);
    const SolvedScene rebuilt = solve(office(kThere));
    ASSERT_EQ(reused.leaf_direct->size(), rebuilt.leaf_direct->size());
    EXPECT_LT(reused.model->link_rays * 2, rebuilt.model->link_rays);
    // Shadow rays end at a standard error of a hundredth.
    EXPECT_LT(relative_rms(*reused.leaf_direct, *rebuilt.leaf_direct), 0.01);
    EXPECT_LT(relative_rms(reused.light->irradiance, rebuilt.light->irradiance), 0.02);
    // Shadows moved: what the earlier state has at the same places is off by more.
    const SceneChange change(earlier.input->scene, earlier.model->tree, reused.input->scene,
                             reused.model->tree);
    std::vector<vec3> stale = *rebuilt.leaf_direct;
    std::size_t kept = 0;
    for (std::size_t n = 0; n < stale.size(); ++n) {
        const NodeId twin = change.earlier(static_cast<NodeId>(n));
        if (twin == kNone) continue;
        stale[n] = (*earlier.leaf_direct)[static_cast<std::size_t>(twin)];
        if (stale[n] != vec3(0) && stale[n] == (*reused.leaf_direct)[n]) ++kept;
    }
    EXPECT_GT(relative_rms(stale, *rebuilt.leaf_direct), 0.03) << "or nothing was edited";
    EXPECT_GT(kept * 2, reused.model->tree.leaves.size());
}

TEST(Reuse, NothingChangedMeansNoRays) {
    const SolvedScene earlier = solve(office(kHere));
    const SolvedScene again = solve(office(kHere), &earlier);
    EXPECT_EQ(again.model->link_rays, 0U);
    EXPECT_EQ(*again.leaf_direct, *earlier.leaf_direct);
    EXPECT_EQ(again.light->irradiance, earlier.light->irradiance);
}

TEST(Reuse, ComingAndGoingObjectsAndTheirShadowsAreSeen) {
    const StageInput with = office(kThere);
    StageInput without;
    without.scene = test::office();
    test::add_point_lamp(without.scene, vec3(1, 2, 2), vec3(20));
    without.options = with.options;
    const SolvedScene has = solve(with);
    const SolvedScene has_not = solve(without);
    for (const auto& [input, earlier, fresh] :
         {std::tuple(&std::as_const(with), &has_not, &has),
          std::tuple(&std::as_const(without), &has, &has_not)}) {
        const SolvedScene reused = solve(*input, earlier);
        ASSERT_EQ(reused.leaf_direct->size(), fresh->leaf_direct->size());
        EXPECT_LT(reused.model->link_rays, fresh->model->link_rays);
        EXPECT_LT(relative_rms(*reused.leaf_direct, *fresh->leaf_direct), 0.01);
        EXPECT_LT(relative_rms(reused.light->irradiance, fresh->light->irradiance), 0.02);
    }
}

TEST(Reuse, LightOfAMovedLampIsTracedAnew) {
    const SolvedScene earlier = solve(office(kHere));
    StageInput edited = office(kThere);
    edited.scene.lamps[0].to_world[3] += vec4(0, 0.7F, 0, 0);
    const SolvedScene reused = solve(edited, &earlier);
    EXPECT_EQ(*reused.leaf_direct, *solve(edited).leaf_direct);
    EXPECT_GT(reused.model->link_rays, 0U);
}

// What emits moves: all its light is another, wherever leaves lie.
TEST(Reuse, LightOfAMovedEmitterIsTracedAnew) {
    const auto with_glow = [](float z) {
        StageInput input = office(kHere);
        const int glow = test::add_material(input.scene, vec3(0), vec3(5));
        test::add_quad(input.scene, "glow", vec3(1, 1, z), vec3(0.2F, 0, 0), vec3(0, 0.2F, 0),
                       glow);
        return input;
    };
    const SolvedScene earlier = solve(with_glow(1.6F));
    EXPECT_EQ(*solve(with_glow(1.9F), &earlier).leaf_direct, *solve(with_glow(1.9F)).leaf_direct);
}

TEST(Reuse, AnotherNumberOfRaysIsTracedAnew) {
    const SolvedScene earlier = solve(office(kHere));
    StageInput edited = office(kHere);
    edited.options.visibility_rays *= 4;
    EXPECT_EQ(solve(edited, &earlier).model->link_rays, solve(edited).model->link_rays);
}

// A board slides between a lamp and the floor below it.
TEST(Reuse, AShadowNeitherStaysNorFailsToCome) {
    constexpr float kPower = 100;  // W
    const auto board_at = [](float x) {
        StageInput input;
        const int grey = test::add_material(input.scene, vec3(0.5F));
        test::add_quad(input.scene, "floor", vec3(-4, -4, 0), vec3(8, 0, 0), vec3(0, 8, 0), grey);
        test::add_box(input.scene, "board", vec3(x - 1, -1, 1), vec3(x + 1, 1, 1.1F), grey);
        test::add_point_lamp(input.scene, vec3(0, 0, 2), vec3(kPower));
        input.options.max_patch_size = 0.5F;
        input.options.solver = SolverChoice::kCpu;
        return input;
    };
    const vec3 below(0.25F, 0.25F, 0);  // the centre of a leaf
    const auto at_that_leaf = [&](const SolvedScene& solved) {
        const NodeId leaf = solved.model->tree.lookup(0, false, below);
        return (*solved.leaf_direct)[static_cast<std::size_t>(leaf)].x;
    };
    // E = I cos / d^2, I = P / (4 pi); the leaf's mean is 1.4 % below that of its centre.
    const float open = kPower / (4 * kPi) * 2 / std::pow(4 + 2 * 0.25F * 0.25F, 1.5F);
    const SolvedScene aside = solve(board_at(3));
    EXPECT_NEAR(at_that_leaf(aside), open, 0.02F * open);
    const SolvedScene covered = solve(board_at(0), &aside);
    EXPECT_EQ(at_that_leaf(covered), 0);
    const SolvedScene back = solve(board_at(3), &covered);
    EXPECT_NEAR(at_that_leaf(back), open, 0.02F * open);
}

}  // namespace
}  // namespace antiradiance
