// SPDX-License-Identifier: GPL-3.0-or-later
// A render stops within half a second in whatever stage it is.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>

#include "base/error.h"
#include "pipeline/session.h"
#include "support/scenes.h"
#include "support/solvers.h"

namespace antiradiance {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLimit = 0.5;  // s, from the wish to the exception

Scene seen_office() {
    Scene scene = test::office();
    test::add_office_camera(scene, 640, 480);
    return scene;
}

// Cancels at the `nth` report of a stage. Empty: the stage was over before.
struct Stop {
    std::string stage;
    int nth;
};
std::optional<double> seconds_to_stop(const Options& options, const Stop& stop,
                                      std::set<std::string>* stages = nullptr) {
    int reports = 0;
    std::optional<Clock::time_point> asked;
    Progress progress(
        [&](float, const std::string& stage) {
            if (stages) stages->insert(stage);
            if (stage == stop.stage && ++reports == stop.nth) asked = Clock::now();
        },
        [&] { return asked.has_value(); });
    try {
        Session().render(seen_office(), options, false, 0, progress);
    } catch (const Cancelled&) {
        return std::chrono::duration<double>(Clock::now() - *asked).count();
    }
    return std::nullopt;
}

Options heavy(SolverChoice solver) {
    Options options;
    options.visibility = Visibility::kExplicit;
    options.visibility_rays = 16;
    options.max_patch_size = 0.5F;
    options.iterations = 1000;
    options.solver = solver;
    return options;
}

TEST(Cancel, InEveryStage) {
    const char* const stages[] = {"Building the patch hierarchy", "Linking patches",
                                  "Testing visibility", "Sorting links", "Direct light"};
    for (const std::string stage : stages) {
        for (const int nth : {1, 4}) {
            const auto seconds = seconds_to_stop(heavy(SolverChoice::kCpu), {stage, nth});
            if (nth == 1) {
                ASSERT_TRUE(seconds) << stage;
            }
            if (!seconds) continue;  // a short stage
            std::cout << stage << ": " << *seconds << " s\n";
            EXPECT_LT(*seconds, kLimit) << stage;
        }
    }
}

using CancelSolve = test::OnEachSolver;
INSTANTIATE_TEST_SUITE_P(, CancelSolve, test::each_solver(), test::solver_name);

TEST_P(CancelSolve, WhileSolving) {
    for (const int nth : {1, 3, 20}) {
        Options options = heavy(GetParam());
        options.visibility = Visibility::kImplicit;
        const auto seconds = seconds_to_stop(options, {"Solving", nth});
        ASSERT_TRUE(seconds) << "1000 passes were over before report " << nth;
        std::cout << "report " << nth << ": " << *seconds << " s\n";
        EXPECT_LT(*seconds, kLimit);
    }
}

TEST(Cancel, WhileChoosingLinks) {
    Options options = heavy(SolverChoice::kCpu);
    options.visibility = Visibility::kMixed;
    for (const int nth : {1, 4}) {
        const auto seconds = seconds_to_stop(options, {"Choosing links", nth});
        ASSERT_TRUE(seconds) << "the links were chosen before report " << nth;
        EXPECT_LT(*seconds, kLimit);
    }
}

TEST(Cancel, WhileDisplaying) {
    for (const int nth : {1, 5}) {
        Options options;
        options.max_patch_size = 1;
        std::set<std::string> stages;
        const auto seconds = seconds_to_stop(options, {"Display", nth}, &stages);
        ASSERT_TRUE(seconds) << "640 x 480 pixels were drawn before report " << nth;
        EXPECT_LT(*seconds, kLimit);
        // Each stage has told its name, so the tests above meant all that there are.
        EXPECT_EQ(stages,
                  std::set<std::string>({"Checking the scene", "Building the patch hierarchy",
                                         "Linking patches", "Testing visibility", "Sorting links",
                                         "Direct light", "Solving", "Display"}));
    }
}

TEST(Cancel, IsWrittenIntoTheReport) {
    Options options;
    options.report_path = std::string(ANTIRADIANCE_BINARY_DIR) + "/report_cancelled.json";
    ASSERT_TRUE(seconds_to_stop(options, {"Linking patches", 1}));
    std::ifstream file(options.report_path);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    EXPECT_NE(text.find("\"error\": \"cancelled\""), std::string::npos) << text;
    std::filesystem::remove(options.report_path);
}

}  // namespace
}  // namespace antiradiance
