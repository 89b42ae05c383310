// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/solver_gl.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/constants.hpp>
#include <iostream>
#include <thread>

#include "base/error.h"
#include "solve/random_transport.h"
#include "solve/reference_jacobi.h"

namespace antiradiance {
namespace {

using test::RandomTransport;
using test::RandomTransportOptions;
using test::ReferenceJacobi;

// Both implementations add a few thousand floats per node and pass, each rounded to 6e-8, in
// different orders; clamps keep errors from growing.
constexpr double kFloatFloor = 2e-5;

// Largest difference over the largest value.
template <class A, class B>
double difference(const std::vector<A>& a, const std::vector<B>& b) {
    double largest = 0, off = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            largest = std::max(largest, std::abs(static_cast<double>(b[i][c])));
            off = std::max(off,
                           std::abs(static_cast<double>(a[i][c]) - static_cast<double>(b[i][c])));
        }
    }
    EXPECT_GT(largest, 0);
    return off / largest;
}

class GlSolverTest : public testing::Test {
protected:
    void SetUp() override {
        std::string why_not;
        if (!make_gl_solver(why_not)) GTEST_SKIP() << why_not;
    }
    static Solution solve(const RandomTransport& transport, int iterations,
                          const GlSolverConfig& config = {}) {
        std::string why_not;
        Progress progress;
        SolveOptions options;
        options.iterations = iterations;
        return make_gl_solver(config, why_not)->solve(transport.problem(), options, progress);
    }
};

void expect_jacobi(const RandomTransport& transport, const Solution& solution, int iterations) {
    ReferenceJacobi reference(transport.problem());
    for (int i = 0; i < iterations; ++i)
        reference.pass();
    EXPECT_LT(difference(solution.radiance, reference.radiance), kFloatFloor);
    EXPECT_LT(difference(solution.irradiance, reference.irradiance), kFloatFloor);
    EXPECT_NEAR(solution.residual, reference.residual, kFloatFloor);
    EXPECT_EQ(solution.iterations, iterations);
}

TEST_F(GlSolverTest, ImplicitPassesAreThoseOfEquations3And4) {
    for (const unsigned seed : {1U, 2U, 3U}) {
        RandomTransportOptions options;
        options.seed = seed;
        const RandomTransport transport(options);
        ASSERT_GT(transport.links.antiradiance_count, 1000U);
        for (const int iterations : {1, 2, 5}) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", passes " << iterations);
            expect_jacobi(transport, solve(transport, iterations), iterations);
        }
    }
}

TEST_F(GlSolverTest, ClustersSendAndReceiveByMoments) {
    for (const unsigned seed : {4U, 5U, 6U}) {
        RandomTransportOptions options;
        options.seed = seed;
        options.antiradiance_share = 0;
        options.cluster_share = 0.3F;
        const RandomTransport transport(options);
        for (const int iterations : {1, 4}) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", passes " << iterations);
            expect_jacobi(transport, solve(transport, iterations), iterations);
        }
    }
}

TEST_F(GlSolverTest, EveryWayToCutTheWorkGivesTheSame) {
    RandomTransportOptions options;
    options.seed = 7;
    options.cluster_share = 0.1F;  // and antiradiance at once
    const RandomTransport transport(options);
    const Solution whole = solve(transport, 4);
    expect_jacobi(transport, whole, 4);
    const std::size_t bin_bytes = transport.tree.size() * 16;
    const std::size_t chunk = 12000;  // of 32 bins' links, 140 kB in all
    const GlSolverConfig cuts[] = {
        {.block_bytes = chunk},                           // chunks
        {.block_bytes = chunk, .resident_bytes = 1},      // all of them sent each pass
        {.block_bytes = chunk, .resident_bytes = 50000},  // some of them
        {.batch_bytes = 1},                               // batches of one bin
        {.batch_bytes = 5 * bin_bytes},                   // 32 is no multiple of 5
        {.links_per_step = 1},                            // a dispatch a segment
        {.links_per_step = 100, .long_segment = 4},       // most segments are long
        {.long_segment = 1},                              // all of them
        {.long_segment = 1U << 20U},                      // none of them
        {.block_bytes = chunk, .batch_bytes = 2 * bin_bytes, .links_per_step = 50},
    };
    for (const GlSolverConfig& cut : cuts) {
        SCOPED_TRACE(testing::Message() << "case " << &cut - &cuts[0]);
        const Solution part = solve(transport, 4, cut);
        EXPECT_LT(difference(part.radiance, whole.radiance), 1e-6);
        EXPECT_LT(difference(part.irradiance, whole.irradiance), 1e-6);
    }
}

TEST_F(GlSolverTest, AgreesWithTheCpu) {
    for (const bool clusters : {false, true}) {
        RandomTransportOptions options;
        options.seed = clusters ? 9 : 8;
        options.antiradiance_share = clusters ? 0 : 0.4F;
        options.cluster_share = clusters ? 0.3F : 0;
        // A cluster sends with all of its area, which would make the light grow.
        if (clusters) options.gain = 0.02F;
        const RandomTransport transport(options);
        for (const int iterations : {6, 0}) {
            SCOPED_TRACE(testing::Message() << "passes " << iterations);
            Progress progress;
            SolveOptions solve_options;
            solve_options.iterations = iterations;
            const Solution cpu =
                make_cpu_solver()->solve(transport.problem(), solve_options, progress);
            const Solution gl = solve(transport, iterations);
            if (iterations == 0) {
                std::cout << cpu.iterations << " CPU, " << gl.iterations << " OpenGL passes\n";
                EXPECT_TRUE(cpu.converged);
                EXPECT_TRUE(gl.converged);
                EXPECT_LT(gl.residual, solve_options.tolerance);
                EXPECT_GT(gl.iterations, 3);
                EXPECT_GT(gl.seconds, 0);
            } else {
                EXPECT_NEAR(gl.residual, cpu.residual, kFloatFloor);
            }
            // A fixed count is the same arithmetic; at convergence both stop at a residual of 1e-4.
            const double floor = iterations > 0 ? kFloatFloor : 1e-3;
            EXPECT_LT(difference(gl.radiance, cpu.radiance), floor);
            EXPECT_LT(difference(gl.irradiance, cpu.irradiance), floor);
            EXPECT_EQ(gl.backend, "OPENGL");
            EXPECT_FALSE(gl.renderer.empty());
        }
    }
}

TEST_F(GlSolverTest, NoLinksLeaveTheSource) {
    RandomTransportOptions options;
    options.segments_per_bin = 0;
    const RandomTransport transport(options);
    const Solution solution = solve(transport, 0);
    EXPECT_TRUE(solution.converged);
    for (const NodeId leaf : transport.tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        EXPECT_EQ(solution.radiance[n], transport.source[n]);
        EXPECT_EQ(solution.irradiance[n], vec3(0));
    }
}

TEST_F(GlSolverTest, NoLightConvergesToNone) {
    RandomTransport transport({});
    std::fill(transport.source.begin(), transport.source.end(), vec3(0));
    const Solution solution = solve(transport, 0);
    EXPECT_TRUE(solution.converged);
    EXPECT_EQ(solution.residual, 0);
    for (const vec3& l : solution.radiance)
        EXPECT_EQ(l, vec3(0));
}

TEST_F(GlSolverTest, OneSolverServesMoreThanOneProblemAndThread) {
    std::string why_not;
    const std::unique_ptr<Solver> solver = make_gl_solver(why_not);
    for (const unsigned seed : {10U, 11U, 12U}) {
        RandomTransportOptions options;
        options.seed = seed;
        options.cluster_share = seed == 11 ? 0.2F : 0;
        const RandomTransport transport(options);
        Solution solution;
        std::thread([&] {
            Progress progress;
            solution = solver->solve(transport.problem(), {.iterations = 3}, progress);
        }).join();
        expect_jacobi(transport, solution, 3);
    }
}

TEST_F(GlSolverTest, BinsLargerThanABufferAreRefused) {
    try {
        (void)solve(RandomTransport({}), 1, {.block_bytes = 1000});
        FAIL() << "fitted 400 links into 1000 bytes";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("use more direction bins"), std::string::npos)
            << error.what();
    }
}

TEST_F(GlSolverTest, CancelsWithinHalfASecond) {
    // About a million links, so that one pass outlasts the limit on a software renderer.
    RandomTransportOptions options;
    options.surfaces = 200;
    options.segments_per_bin = 3000;
    options.links_per_segment = 12;
    const RandomTransport transport(options);
    std::string why_not;
    const std::unique_ptr<Solver> solver = make_gl_solver(why_not);
    using Clock = std::chrono::steady_clock;
    for (const int reports : {1, 4, 40}) {
        Clock::time_point asked{};
        int seen = 0;
        Progress progress(
            [&](float fraction, const std::string&) {
                EXPECT_GE(fraction, 0);
                EXPECT_LE(fraction, 1);
                if (++seen == reports) asked = Clock::now();
            },
            [&] { return seen >= reports; });
        EXPECT_THROW((void)solver->solve(transport.problem(), {.iterations = 1000}, progress),
                     Cancelled);
        const double seconds = std::chrono::duration<double>(Clock::now() - asked).count();
        EXPECT_LT(seconds, 0.5);
    }
}

TEST(NoGlSolver, GivesTheReason) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    const auto make = [] {
        setenv("ANTIRADIANCE_NO_OPENGL", "1", 1);
        std::string why_not;
        const bool null = make_gl_solver(why_not) == nullptr;
        std::cerr << why_not;
        std::exit(null ? 0 : 1);
    };
    EXPECT_EXIT(make(), testing::ExitedWithCode(0), "ANTIRADIANCE_NO_OPENGL");
}

}  // namespace
}  // namespace antiradiance
