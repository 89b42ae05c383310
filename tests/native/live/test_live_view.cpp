// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/live_view.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "pipeline/session.h"
#include "support/scene_builder.h"
#include "support/scenes.h"
#include "waiting.h"

namespace antiradiance {
namespace {

using test::sleep_ms;
using test::wait_for;

StageInput office(int width = 32, int height = 24) {
    StageInput input;
    input.scene = test::office();
    test::add_point_lamp(input.scene, vec3(1, 2, 2), vec3(20));
    test::add_office_camera(input.scene, width, height);
    input.options.max_patch_size = 1;
    input.options.solver = SolverChoice::kCpu;
    return input;
}

bool shows(const LiveView& view, LevelName level, std::uint64_t solution) {
    const auto newest = view.newest();
    return newest && newest->level == level && newest->solution == solution;
}

Camera moved(Camera camera, float metres) {
    camera.to_world[3].y += metres;
    return camera;
}

class LiveViewOfTheOffice : public testing::Test {
protected:
    void solve() {
        solver_->post(input_);
        ASSERT_TRUE(wait_for([&] { return !solver_->state().working; }));
    }
    void show() {
        view_.set_camera(input_.scene.camera);
        ASSERT_TRUE(
            wait_for([&] { return shows(view_, LevelName::kFinal, solver_->newest()->number); }));
    }

    StageInput input_ = office();
    std::shared_ptr<LiveSolver> solver_ = std::make_shared<LiveSolver>();
    LiveView view_{solver_};
};

TEST_F(LiveViewOfTheOffice, EndsWithThePictureOfARender) {
    solve();
    show();
    Session session;
    Progress progress;
    const RenderResult rendered =
        session.render(input_.scene, input_.options, input_.film_transparent, 0, progress);
    EXPECT_EQ(view_.newest()->picture.combined, rendered.picture.combined);
    EXPECT_TRUE(wait_for([&] { return !view_.state().making; })) << "and comes to rest";
}

TEST_F(LiveViewOfTheOffice, ShowsNothingBeforeThereIsASolution) {
    view_.set_camera(input_.scene.camera);
    sleep_ms(50);
    EXPECT_EQ(view_.newest(), nullptr);
}

TEST_F(LiveViewOfTheOffice, QualityRisesFromPictureToPicture) {
    solve();
    std::vector<LevelName> levels;
    view_.set_camera(input_.scene.camera);
    ASSERT_TRUE(wait_for([&] {
        const auto newest = view_.newest();
        if (newest && (levels.empty() || levels.back() != newest->level))
            levels.push_back(newest->level);
        return newest && newest->level == LevelName::kFinal;
    }));
    EXPECT_TRUE(std::ranges::is_sorted(levels));
    EXPECT_GE(levels.size(), 2U);
}

TEST_F(LiveViewOfTheOffice, AMovedCameraSolvesNothing) {
    solve();
    show();
    const auto solution = solver_->newest();
    view_.set_camera(moved(input_.scene.camera, 0.1F));
    ASSERT_TRUE(wait_for([&] {
        return view_.newest()->camera == moved(input_.scene.camera, 0.1F) &&
               view_.newest()->level == LevelName::kFinal;
    }));
    EXPECT_EQ(solver_->newest(), solution);
    EXPECT_EQ(solver_->state().edits, 1U);
}

TEST_F(LiveViewOfTheOffice, NavigationPicturesComeWhileTheCameraMoves) {
    solve();
    show();
    for (int i = 1; i <= 40; ++i) {
        view_.set_camera(moved(input_.scene.camera, 0.01F * static_cast<float>(i)));
        sleep_ms(10);
    }
    // A picture takes some ms; the view never rested.
    EXPECT_GE(view_.state().navigation_pictures, 5U);
    EXPECT_LT(view_.newest()->level, LevelName::kInterleaved);
}

TEST_F(LiveViewOfTheOffice, NavigationPicturesComeWhileTheSolverWorks) {
    solve();
    show();
    StageInput much = input_;
    much.options.max_patch_size = 0.08F;
    much.options.link_threshold = 0.002F;
    solver_->post(much);
    const std::uint64_t before = view_.state().navigation_pictures;
    int moves = 0;
    ASSERT_TRUE(wait_for([&] {
        view_.set_camera(moved(input_.scene.camera, 0.001F * static_cast<float>(++moves)));
        return view_.state().navigation_pictures >= before + 5;
    }));
    EXPECT_TRUE(solver_->state().working) << "or the test shows nothing";
}

TEST_F(LiveViewOfTheOffice, ANewSolutionIsShown) {
    solve();
    show();
    const float before = view_.newest()->picture.combined[0].x;
    input_.scene.lamps[0].power *= 4.0F;
    solve();
    show();
    EXPECT_GT(view_.newest()->picture.combined[0].x, before);
}

TEST_F(LiveViewOfTheOffice, TwoViewsShareASolver) {
    LiveView other(solver_);
    solve();
    show();
    other.set_camera(moved(input_.scene.camera, 0.3F));
    ASSERT_TRUE(
        wait_for([&] { return shows(other, LevelName::kFinal, solver_->newest()->number); }));
    EXPECT_NE(other.newest()->picture.combined, view_.newest()->picture.combined);
    EXPECT_EQ(solver_->state().edits, 1U);
}

TEST_F(LiveViewOfTheOffice, WhilePausedTheOldSolutionIsShownAtItsBest) {
    solve();
    show();
    const std::uint64_t solution = solver_->newest()->number;
    solver_->pause(true);
    input_.scene.lamps[0].power *= 4.0F;
    solver_->post(input_);
    view_.set_camera(moved(input_.scene.camera, 0.2F));
    ASSERT_TRUE(wait_for([&] {
        return view_.newest()->camera == moved(input_.scene.camera, 0.2F) &&
               view_.newest()->level == LevelName::kFinal;
    }));
    EXPECT_EQ(view_.newest()->solution, solution);
    solver_->pause(false);
}

TEST_F(LiveViewOfTheOffice, InspectionsAreDrawnInsteadOfThePicture) {
    solve();
    show();
    const auto picture = view_.newest();
    for (const InspectMode mode : {InspectMode::kHierarchy, InspectMode::kExplicitDifference}) {
        const std::uint64_t before = view_.newest()->number;
        view_.set_inspection({.mode = mode});
        ASSERT_TRUE(wait_for([&] {
            return view_.newest()->number > before && view_.newest()->level == LevelName::kFinal;
        }));
        const auto drawn = view_.newest();
        EXPECT_EQ(drawn->picture.combined.size(), picture->picture.combined.size());
        EXPECT_NE(drawn->picture.combined, picture->picture.combined);
    }
    // The visibility is EXPLICIT: it differs from itself nowhere.
    for (const vec4& pixel : view_.newest()->picture.combined) {
        EXPECT_EQ(pixel.x, pixel.y);
        EXPECT_EQ(pixel.x, pixel.z);
    }
    view_.set_inspection({});
    EXPECT_TRUE(
        wait_for([&] { return view_.newest()->picture.combined == picture->picture.combined; }));
}

TEST_F(LiveViewOfTheOffice, StopsInTheMiddleOfAPicture) {
    input_ = office(640, 480);
    input_.options.direct_samples = 256;
    solve();
    view_.set_camera(input_.scene.camera);
    ASSERT_TRUE(wait_for([&] { return view_.state().making == LevelName::kFinal; }));
    const auto begin = std::chrono::steady_clock::now();
    view_.stop();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2))
        << "the picture itself takes far longer";
    EXPECT_LT(view_.newest()->level, LevelName::kFinal);
}

}  // namespace
}  // namespace antiradiance
