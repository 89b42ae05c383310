// SPDX-License-Identifier: GPL-3.0-or-later
// Which back end the artist's choice means, and what happens where it can't be had or fails.
#include "pipeline/choose_device.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <vector>

#include "gpu/gl_error.h"
#include "gpu/gl_thread.h"
#include "pipeline/session.h"
#include "support/scenes.h"

namespace antiradiance {
namespace {

TEST(ChooseDevice, CpuIsTakenAtItsWord) {
    std::vector<bool> calls;
    const DeviceUse use =
        run_on_device(SolverChoice::kCpu, "solver", [&](bool opengl) { calls.push_back(opengl); });
    EXPECT_EQ(calls, std::vector<bool>{false});
    EXPECT_EQ(use.reason, "asked for");
    EXPECT_EQ(use.warning, "");
}

TEST(ChooseDevice, AutomaticGoesOnWithTheCpuWhenOpenGlFails) {
    std::string why_not;
    const auto gl = gpu::GlThread::shared(why_not);
    const bool card = gl && !gl->device().is_software;
    std::vector<bool> calls;
    const DeviceUse use = run_on_device(SolverChoice::kAuto, "display", [&](bool opengl) {
        calls.push_back(opengl);
        if (opengl) throw gpu::GlError("out of memory");
    });
    EXPECT_FALSE(calls.back());
    EXPECT_EQ(calls.size(), card ? 2U : 1U) << "a software renderer is never chosen";
    if (card) {
        EXPECT_EQ(use.warning,
                  "The CPU's display took over, because the OpenGL display failed: out of memory");
    } else {
        EXPECT_EQ(use.warning, "");
        EXPECT_NE(use.reason.find(gl ? "is software" : "there is no OpenGL"), std::string::npos)
            << use.reason;
    }
}

TEST(ChooseDevice, OpenGlThatWasAskedForFailsAloud) {
    std::string why_not;
    if (!gpu::GlThread::shared(why_not)) GTEST_SKIP() << why_not;
    int calls = 0;
    EXPECT_THROW(run_on_device(SolverChoice::kOpenGL, "display",
                               [&](bool) {
                                   ++calls;
                                   throw gpu::GlError("out of memory");
                               }),
                 gpu::GlError);
    EXPECT_EQ(calls, 1);
}

TEST(ChooseDevice, OpenGlThatCanNotBeHadSaysWhatToDo) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    const auto choose = [] {
        setenv("ANTIRADIANCE_NO_OPENGL", "1", 1);
        const DeviceUse use = run_on_device(SolverChoice::kAuto, "display",
                                            [](bool opengl) { std::exit(opengl ? 1 : 0); });
    };
    EXPECT_EXIT(choose(), testing::ExitedWithCode(0), "");
    const auto insist = [] {
        setenv("ANTIRADIANCE_NO_OPENGL", "1", 1);
        try {
            run_on_device(SolverChoice::kOpenGL, "display", [](bool) {});
        } catch (const std::runtime_error& error) {
            std::cerr << error.what();
            std::exit(0);
        }
        std::exit(1);
    };
    EXPECT_EXIT(
        insist(), testing::ExitedWithCode(0),
        "OpenGL display can't run: .*ANTIRADIANCE_NO_OPENGL.*set Device to Automatic or CPU");
}

// Where each display mode is computed, as the report tells.
TEST(ChooseDevice, TheDisplayTakesTheSolversDevice) {
    std::string why_not;
    if (!gpu::GlThread::shared(why_not)) GTEST_SKIP() << why_not;
    Scene scene = test::office();
    scene.has_camera = true;
    scene.camera.to_world[3] = vec4(3, 2, 1.5F, 1);
    scene.camera.width = scene.camera.x1 = 16;
    scene.camera.height = scene.camera.y1 = 12;
    struct Case {
        SolverChoice solver;
        DisplayMode mode;
        ShootingVisibility visibility;
        const char* backend;
    };
    const Case cases[] = {
        {SolverChoice::kOpenGL, DisplayMode::kSplatting, ShootingVisibility::kAuto, "OPENGL"},
        {SolverChoice::kOpenGL, DisplayMode::kFinalShooting, ShootingVisibility::kAntiradiance,
         "OPENGL"},
        {SolverChoice::kOpenGL, DisplayMode::kFinalShooting, ShootingVisibility::kRays, "CPU"},
        {SolverChoice::kOpenGL, DisplayMode::kPatches, ShootingVisibility::kAuto, "CPU"},
        {SolverChoice::kCpu, DisplayMode::kSplatting, ShootingVisibility::kAuto, "CPU"},
    };
    Session session;
    for (const Case& c : cases) {
        Options options;
        options.max_patch_size = 1;
        options.link_threshold = 0.2F;
        options.solver = c.solver;
        options.display = c.mode;
        options.shooting_visibility = c.visibility;
        Progress progress;
        const Report report = session.render(scene, options, false, 0, progress).report;
        SCOPED_TRACE(report.display.mode);
        EXPECT_EQ(report.display.backend, c.backend);
        EXPECT_FALSE(report.display.renderer.empty());
    }
}

}  // namespace
}  // namespace antiradiance
