// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/live_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "pipeline/session.h"
#include "support/scene_builder.h"
#include "support/scenes.h"
#include "waiting.h"

namespace antiradiance {
namespace {

constexpr int kWood = 2;  // material of the office's desks

using test::sleep_ms;
using test::wait_for;

bool wait_until_done(const LiveSolver& solver) {
    return wait_for([&] { return !solver.state().working; });
}

StageInput office() {
    StageInput input;
    input.scene = test::office();
    test::add_point_lamp(input.scene, vec3(1, 2, 2), vec3(20));
    input.options.max_patch_size = 0.5F;
    input.options.solver = SolverChoice::kCpu;
    return input;
}

// Some seconds of work: long enough to be met while it runs.
StageInput much_work() {
    StageInput input = office();
    input.options.max_patch_size = 0.08F;
    input.options.link_threshold = 0.002F;
    return input;
}

std::string ran(const Report& report) {
    std::string names;
    for (const auto& [name, what] : report.stages) {
        if (what == "run") names += (names.empty() ? "" : " ") + name;
    }
    return names;
}

TEST(LiveSolver, ACoarseSolutionComesBeforeTheWholeOne) {
    LiveSolver solver;
    EXPECT_FALSE(solver.state().working);
    EXPECT_EQ(solver.newest(), nullptr);
    solver.post(office());
    std::vector<std::shared_ptr<const LiveSolver::Solution>> seen;
    ASSERT_TRUE(wait_for([&] {
        const auto newest = solver.newest();
        if (newest && (seen.empty() || seen.back() != newest)) seen.push_back(newest);
        return !solver.state().working;
    }));
    seen.push_back(solver.newest());
    ASSERT_GE(seen.size(), 2U);
    const LiveSolver::Solution& first = *seen.front();
    const LiveSolver::Solution& last = *seen.back();
    EXPECT_TRUE(first.preliminary);
    EXPECT_FALSE(last.preliminary);
    EXPECT_LT(first.report.leaves * 4, last.report.leaves);
    EXPECT_LT(first.report.links.total * 4, last.report.links.total);
}

TEST(LiveSolver, AMovedObjectKeepsTheRaysThatItDoesNotTouch) {
    const auto with_box = [](float x) {
        StageInput input = office();
        test::add_box(input.scene, "box", {x, 2.6F, 0.1F}, {x + 0.3F, 2.9F, 0.5F}, kWood);
        return input;
    };
    LiveSolver solver;
    solver.post(with_box(1));
    ASSERT_TRUE(wait_until_done(solver));
    const std::size_t all = solver.newest()->report.visibility.rays;
    solver.post(with_box(1.3F));
    ASSERT_TRUE(wait_until_done(solver));
    const LiveSolver::Solution& moved = *solver.newest();
    EXPECT_FALSE(moved.preliminary);
    EXPECT_GT(moved.report.visibility.rays, 0U);
    EXPECT_LT(moved.report.visibility.rays * 2, all);
    // It is there: the box has patches, and they have light.
    const PatchTree& tree = moved.scene.model->tree;
    float brightest = 0;
    for (const NodeId leaf : tree.leaves) {
        const vec3& c = tree.center[static_cast<std::size_t>(leaf)];
        if (c.x > 1.35F && c.x < 1.55F && c.y > 2.65F && c.y < 2.85F && c.z == 0.5F)
            brightest =
                std::max(brightest, (*moved.scene.leaf_direct)[static_cast<std::size_t>(leaf)].x);
    }
    EXPECT_GT(brightest, 0);
}

TEST(LiveSolver, TheWholeSolutionIsThatOfARender) {
    LiveSolver solver;
    const StageInput input = office();
    solver.post(input, 0.5);
    ASSERT_TRUE(wait_until_done(solver));
    Stages stages;
    Progress progress;
    Report report;
    const SolvedScene rendered = stages.run(input, progress, report);
    const auto live = solver.newest();
    EXPECT_EQ(live->scene.light->irradiance, rendered.light->irradiance);
    EXPECT_EQ(live->report.timings_s.sync, 0.5);
    EXPECT_GT(live->report.timings_s.total, 0.5);
}

TEST(LiveSolver, RunsOnlyTheStagesThatAnEditConcerns) {
    LiveSolver solver;
    StageInput input = office();
    solver.post(input);
    ASSERT_TRUE(wait_until_done(solver));
    const auto after = [&](const std::function<void(StageInput&)>& edit) {
        edit(input);
        solver.post(input);
        EXPECT_TRUE(wait_until_done(solver));
        EXPECT_FALSE(solver.newest()->preliminary);
        return ran(solver.newest()->report);
    };
    EXPECT_EQ(after([](StageInput& i) { i.scene.lamps[0].power *= 2.0F; }),
              "direct_light transport solve evaluation");
    EXPECT_EQ(after([](StageInput& i) { i.scene.materials[kWood].albedo = vec3(0.2F); }),
              "transport solve evaluation");
    EXPECT_EQ(after([](StageInput& i) { i.scene.background = vec3(1); }), "");
    EXPECT_EQ(after([](StageInput& i) { i.scene.positions[0].x += 0.01F; }),
              "model pruning direct_light transport solve evaluation");
}

TEST(LiveSolver, ADimmedLampIsShownOnTheLinksThatThereAre) {
    LiveSolver solver;
    StageInput input = much_work();
    input.options.link_threshold = 0.1F;  // shadow rays take most of the time
    solver.post(input);
    ASSERT_TRUE(wait_until_done(solver));
    const auto before = solver.newest();
    input.scene.lamps[0].power *= 0.5F;
    solver.post(input);
    ASSERT_TRUE(wait_for([&] { return solver.newest() != before; }));
    const auto first = solver.newest();
    EXPECT_TRUE(first->preliminary);
    EXPECT_EQ(first->scene.model, before->scene.model);
    EXPECT_EQ(ran(first->report), "transport solve evaluation");
    ASSERT_TRUE(wait_until_done(solver));
    EXPECT_EQ(ran(solver.newest()->report), "direct_light transport solve evaluation");
}

TEST(LiveSolver, APostThatChangesNothingIsNoEdit) {
    LiveSolver solver;
    solver.post(office());
    ASSERT_TRUE(wait_until_done(solver));
    const auto before = solver.newest();
    StageInput same = office();
    same.scene.has_camera = true;  // views have cameras of their own
    same.scene.camera.width = 100;
    same.options.report_path = "nowhere";
    same.options.evaluate_pruning = true;
    solver.post(same);
    EXPECT_FALSE(solver.state().working);
    EXPECT_EQ(solver.state().edits, 1U);
    EXPECT_EQ(solver.newest(), before);
}

TEST(LiveSolver, TheNewestEditCancelsRunningWork) {
    LiveSolver solver;
    solver.post(much_work());
    ASSERT_TRUE(wait_for([&] { return !solver.state().stage.empty(); }));
    const auto begin = std::chrono::steady_clock::now();
    solver.post(office());
    ASSERT_TRUE(wait_until_done(solver));
    Stages fresh;
    Progress progress;
    Report report;
    fresh.run(office(), progress, report);
    EXPECT_EQ(solver.newest()->report.links.total, report.links.total);
    EXPECT_FALSE(solver.newest()->preliminary);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(LiveSolver, AnEditThatIsDraggedIsShownOnTheWay) {
    LiveSolver solver;
    StageInput input = office();
    input.options.max_patch_size = 0.2F;
    solver.post(input);
    ASSERT_TRUE(wait_until_done(solver));
    // Edits come faster than solutions. Those of lamps are relit, those of geometry made coarse.
    const auto drag_until_shown = [&](const std::function<void()>& edit) {
        const std::uint64_t before = solver.newest()->number;
        std::uint64_t edits = 0;
        EXPECT_TRUE(wait_for([&] {
            edit();
            solver.post(input);
            ++edits;
            return solver.newest()->number >= before + 2;
        }));
        EXPECT_GT(edits, 2U) << "or the solutions were not in the edits' way";
    };
    drag_until_shown([&] { input.scene.lamps[0].power *= 1.01F; });
    drag_until_shown([&] { input.scene.positions[0].x += 0.001F; });
    ASSERT_TRUE(wait_until_done(solver));
    EXPECT_EQ(solver.newest()->scene.input->scene.lamps[0].power, input.scene.lamps[0].power);
    EXPECT_EQ(solver.newest()->scene.input->scene.positions[0], input.scene.positions[0]);
}

TEST(LiveSolver, AnEditThatSolvesForTheSameLetsTheWorkGoOn) {
    LiveSolver solver;
    StageInput input = office();
    solver.pause(true);
    solver.post(input);
    ASSERT_TRUE(wait_for([&] { return !solver.state().stage.empty(); }));
    input.scene.background = vec3(1);
    solver.post(input);
    solver.pause(false);
    ASSERT_TRUE(wait_until_done(solver));
    const auto newest = solver.newest();
    EXPECT_EQ(newest->scene.input->scene.background, vec3(1));
    EXPECT_EQ(ran(newest->report), "") << "the run before was not cancelled";
}

TEST(LiveSolver, EditsWaitWhilePaused) {
    LiveSolver solver;
    solver.pause(true);
    solver.pause(true);
    solver.post(office());
    sleep_ms(200);
    EXPECT_TRUE(solver.state().working);
    EXPECT_TRUE(solver.state().paused);
    EXPECT_EQ(solver.newest(), nullptr);
    solver.pause(false);
    ASSERT_TRUE(wait_until_done(solver));
    EXPECT_NE(solver.newest(), nullptr);
}

TEST(LiveSolver, SaysWhatIsWrongUntilItIsCured) {
    LiveSolver solver;
    solver.post(office());
    ASSERT_TRUE(wait_until_done(solver));
    const auto before = solver.newest();
    StageInput bad = office();
    bad.scene.textures.push_back({.name = "paper",
                                  .width = 0,
                                  .height = 0,
                                  .pixels = {},
                                  .missing_path = "/nowhere/paper.png"});
    bad.scene.materials[kWood].albedo_texture = 0;
    solver.post(bad);
    ASSERT_TRUE(wait_until_done(solver));
    EXPECT_NE(solver.state().error.find("paper.png"), std::string::npos) << solver.state().error;
    EXPECT_EQ(solver.newest(), before);
    solver.post(office());
    ASSERT_TRUE(wait_until_done(solver));
    EXPECT_EQ(solver.state().error, "");
}

TEST(LiveSolver, StopsInTheMiddleOfItsWork) {
    auto solver = std::make_unique<LiveSolver>();
    solver->post(much_work());
    ASSERT_TRUE(wait_for([&] { return !solver->state().stage.empty(); }));
    solver->pause(true);  // also then
    solver.reset();
}

}  // namespace
}  // namespace antiradiance
