// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/gl_test.h"

namespace antiradiance::gpu {
namespace {

class GlThreadTest : public GlTest {};

TEST_F(GlThreadTest, DescribesTheDevice) {
    const DeviceInfo& device = gl->device();
    std::cout << device.vendor << " / " << device.renderer << " / " << device.version << ", "
              << (device.max_storage_block_bytes >> 20U) << " MiB a block, "
              << device.max_compute_storage_blocks << " blocks\n";
    EXPECT_FALSE(device.renderer.empty());
    // The least that OpenGL 4.5 lets a driver offer (table 23.64).
    EXPECT_GE(device.max_storage_block_bytes, std::size_t{1} << 24U);
    EXPECT_GE(device.max_compute_storage_blocks, 8);
    EXPECT_GE(device.max_work_groups, 65535U);
    const bool is_llvmpipe = device.renderer.find("llvmpipe") != std::string::npos;
    EXPECT_TRUE(!is_llvmpipe || device.is_software);
}

TEST_F(GlThreadTest, ReturnsResultsFromOneThread) {
    const auto id = [](GlContext&) { return std::this_thread::get_id(); };
    const std::thread::id first = gl->run(id);
    EXPECT_NE(first, std::this_thread::get_id());
    std::vector<std::thread::id> seen(8);
    std::vector<std::thread> callers;
    for (std::thread::id& slot : seen) {
        callers.emplace_back([&] {
            for (int i = 0; i < 100; ++i)
                slot = gl->run(id);
        });
    }
    for (std::thread& caller : callers)
        caller.join();
    EXPECT_EQ(seen, std::vector<std::thread::id>(8, first));
}

TEST_F(GlThreadTest, RunsWorkOfItsOwnWorkAtOnce) {
    EXPECT_EQ(gl->run([&](GlContext&) { return gl->run([](GlContext&) { return 7; }); }), 7);
}

TEST_F(GlThreadTest, ForwardsExceptions) {
    EXPECT_THROW(gl->run([](GlContext&) { throw std::out_of_range("mine"); }), std::out_of_range);
    EXPECT_EQ(gl->run([](GlContext&) { return 1; }), 1);
}

TEST_F(GlThreadTest, ReportsFailedCallsOnce) {
    const auto overrun = [](GlContext&) {
        RawBuffer buffer(16, nullptr);
        const std::array<float, 8> values{};
        buffer.write(0, sizeof values, values.data());
    };
    EXPECT_THROW(gl->run(overrun), GlError);
    EXPECT_NO_THROW(gl->run([](GlContext&) {}));
}

TEST_F(GlThreadTest, ReportsABufferLargerThanTheDevice) {
    EXPECT_THROW(gl->run([](GlContext&) { RawBuffer(std::size_t{1} << 46U, nullptr); }), GlError);
    EXPECT_NO_THROW(gl->run([](GlContext&) { RawBuffer(16, nullptr); }));
}

TEST_F(GlThreadTest, SecondThreadBesideTheSharedOne) {
    GlThread other;
    EXPECT_EQ(other.device().renderer, gl->device().renderer);
    EXPECT_EQ(other.run([](GlContext&) { return 2; }), 2);
}

// In a child process each, since the answer is kept for a process's life.
int exit_code_without(const char* variable, const char* value) {
    setenv(variable, value, 1);
    std::string why_not;
    const bool null = GlThread::shared(why_not) == nullptr;
    std::cerr << why_not;
    return null && !why_not.empty() ? 0 : 1;
}

TEST(NoOpenGL, SwitchedOff) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    EXPECT_EXIT(std::exit(exit_code_without("ANTIRADIANCE_NO_OPENGL", "1")),
                testing::ExitedWithCode(0), "switched off by ANTIRADIANCE_NO_OPENGL");
}

TEST(NoOpenGL, NoDriver) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    // GLVND then finds no vendor's library, as on a machine without Mesa's.
    EXPECT_EXIT(std::exit(exit_code_without("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json")),
                testing::ExitedWithCode(0), "no OpenGL 4.5 device");
}

TEST_F(GlThreadTest, EndsWithTheProcess) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    const auto use_and_exit = [] {
        std::string why_not;
        GlThread::shared(why_not)->run([](GlContext&) { RawBuffer(1024, nullptr); });
        std::exit(0);
    };
    EXPECT_EXIT(use_and_exit(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace antiradiance::gpu
