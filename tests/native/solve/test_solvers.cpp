// SPDX-License-Identifier: GPL-3.0-or-later
// What both solvers must do, on link meshes small enough to solve by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "solve/hand_made_transport.h"
#include "solve/random_transport.h"
#include "support/solvers.h"

namespace antiradiance {
namespace {

using test::HandMadeTransport;

using Solvers = test::OnEachSolver;
INSTANTIATE_TEST_SUITE_P(, Solvers, test::each_solver(), test::solver_name);

constexpr float kFloatFloor = 1e-6F;  // sums of a few floats about 1

// An emitter of radiance 1 (node 1) below `count` slabs (nodes 2..), each of which receives 1 W/m2
// of what is left of the light in front of it and stops the share `opacity` of that.
HandMadeTransport slabs(int count, float opacity) {
    HandMadeTransport stack(count + 1);
    stack.source[1] = vec3(1);
    for (NodeId slab = 2; slab < count + 2; ++slab) {
        std::vector<HandMadeTransport::Incoming> incoming{{1, 1}};
        for (NodeId before = 2; before < slab; ++before)
            incoming.push_back({before, -1});
        stack.add(0, slab, 1 / opacity, incoming);
        stack.albedo[static_cast<std::size_t>(slab)] = vec3(0.5F);
    }
    return stack;
}

float slab_irradiance(const Solution& s, int slab) {
    return s.irradiance[static_cast<std::size_t>(slab) + 2].x;
}

TEST_P(Solvers, OnlyTheFirstOfAStackOfOpaqueSlabsReceives) {
    constexpr int kSlabs = 7;
    const HandMadeTransport stack = slabs(kSlabs, 1);
    // Pass 1 knows no antiradiance: light goes through. Without clamps Jacobi would need a pass a
    // slab; the clamp A >= 0 ends what the false light of pass 1 set off.
    const Solution first = solver->solve(stack.problem(), {.iterations = 1}, progress);
    EXPECT_NEAR(slab_irradiance(first, kSlabs - 1), 1, kFloatFloor);
    for (const int passes : {2, 3, 10, 0}) {
        const Solution s = solver->solve(stack.problem(), {.iterations = passes}, progress);
        EXPECT_NEAR(slab_irradiance(s, 0), 1, kFloatFloor);
        for (int slab = 1; slab < kSlabs; ++slab)
            EXPECT_NEAR(slab_irradiance(s, slab), 0, kFloatFloor) << passes << " passes, " << slab;
    }
}

TEST_P(Solvers, JacobiNeedsOnePassForEachSlabThatHalvesTheLight) {
    constexpr int kSlabs = 7;
    const HandMadeTransport stack = slabs(kSlabs, 0.5F);
    const auto error = [&](int passes) {
        const Solution s = solver->solve(stack.problem(), {.iterations = passes}, progress);
        float largest = 0;
        for (int slab = 0; slab < kSlabs; ++slab) {
            largest = std::max(
                largest, std::abs(slab_irradiance(s, slab) - std::exp2(-static_cast<float>(slab))));
        }
        return largest;
    };
    EXPECT_GT(error(kSlabs - 1), 0.01F);
    EXPECT_LT(error(kSlabs), kFloatFloor);
    EXPECT_LT(error(0), kFloatFloor);
}

TEST(CpuSolver, OneSweepSolvesAStackOfSlabs) {
    for (const float opacity : {0.5F, 1.0F}) {
        const HandMadeTransport stack = slabs(7, opacity);
        Progress progress;
        const Solution s = make_cpu_solver()->solve(stack.problem(), {}, progress);
        EXPECT_EQ(s.iterations, 2) << "one to solve, one to see that nothing changes";
        EXPECT_TRUE(s.converged);
        EXPECT_NEAR(slab_irradiance(s, 6), opacity < 1 ? 1.0F / 64 : 0.0F, kFloatFloor);
    }
}

TEST_P(Solvers, AntiradianceIsNeverMoreThanTheLargestRadiance) {
    // Node 2 receives 1 W/m2 within .2 sr: A would be 5 where no light is brighter than 1 (red) or
    // 2 (blue).
    HandMadeTransport t(3);
    t.source[1] = vec3(1, 0, 2);
    t.albedo[3] = vec3(0.5F);  // a solver that looks at L alone sees when A has settled
    t.add(0, 2, 0.2F, {{1, 1}});
    t.add(0, 3, 1, {{1, 0.4F}, {2, -0.1F}});
    for (const int passes : {3, 0}) {
        const Solution s = solver->solve(t.problem(), {.iterations = passes}, progress);
        EXPECT_NEAR(s.irradiance[3].x, 0.4F - 0.1F, kFloatFloor);
        EXPECT_NEAR(s.irradiance[3].y, 0, kFloatFloor);
        EXPECT_NEAR(s.irradiance[3].z, 0.8F - 0.2F, kFloatFloor);
    }
}

TEST_P(Solvers, AntiradianceIsNeverNegative) {
    // Node 3 gets nothing but the antiradiance of node 2; what it sends on must not be light.
    HandMadeTransport t(4);
    t.source[1] = vec3(1);
    t.add(0, 2, 1, {{1, 1}});
    t.add(0, 3, 1, {{2, -1}});
    t.add(0, 4, 1, {{1, 0.25F}, {3, -1}});
    for (const int passes : {3, 10, 0}) {
        const Solution s = solver->solve(t.problem(), {.iterations = passes}, progress);
        EXPECT_NEAR(s.irradiance[4].x, 0.25F, kFloatFloor);
        EXPECT_EQ(s.irradiance[3].x, 0);
    }
}

TEST_P(Solvers, RadianceIsNeverNegativeButABinMayBe) {
    // Node 3: -1 and +.75 W/m2 from two bins, a sum below 0, so node 4 gets nothing from it.
    // Node 5: -.25 and +.75, of which .5 are left.
    HandMadeTransport t(5);
    t.source[1] = vec3(1);
    t.albedo.assign(t.albedo.size(), vec3(1));
    t.add(0, 2, 1, {{1, 1}});
    t.add(0, 3, 1, {{2, -1}});
    t.add(0, 5, 1, {{2, -0.25F}});
    t.add(1, 3, 1, {{1, 0.75F}});
    t.add(1, 5, 1, {{1, 0.75F}});
    t.add(2, 4, 1, {{3, 1}, {5, 1}});
    for (const int passes : {4, 0}) {
        const Solution s = solver->solve(t.problem(), {.iterations = passes}, progress);
        EXPECT_EQ(s.radiance[3].x, 0);
        EXPECT_NEAR(s.irradiance[5].x, 0.5F, kFloatFloor);
        EXPECT_NEAR(s.irradiance[4].x, 0.5F * kInvPi, kFloatFloor);
    }
}

TEST_P(Solvers, TwoPatchesExchangeAGeometricSeries) {
    HandMadeTransport t(2);
    t.source[1] = vec3(1);
    t.albedo[1] = t.albedo[2] = vec3(0.8F, 0.5F, 0);
    t.add(0, 1, 1, {{2, 0.5F * kPi}});
    t.add(1, 2, 1, {{1, 0.5F * kPi}});
    // L1 = 1 + a/2 L2, L2 = a/2 L1
    const Solution s = solver->solve(t.problem(), {.tolerance = 1e-6F}, progress);
    EXPECT_TRUE(s.converged);
    for (int c = 0; c < 3; ++c) {
        const float half = 0.5F * t.albedo[1][c];
        EXPECT_NEAR(s.radiance[1][c], 1 / (1 - half * half), 1e-5F);
        EXPECT_NEAR(s.radiance[2][c], half / (1 - half * half), 1e-5F);
    }
    // A fixed count is a partial sum: a pass a bounce, as the paper's Jacobi.
    const Solution two = solver->solve(t.problem(), {.iterations = 2}, progress);
    EXPECT_NEAR(two.radiance[1].x, 1 + 0.4F * 0.4F, kFloatFloor);
    EXPECT_NEAR(two.radiance[2].x, 0.4F, kFloatFloor);
    EXPECT_FALSE(two.converged);
}

TEST_P(Solvers, LightThatGrowsIsReportedAndStaysFinite) {
    // Each patch returns 1.2 times what it gets: no damping can make that converge.
    HandMadeTransport t(2);
    t.source[1] = vec3(1);
    t.albedo[1] = t.albedo[2] = vec3(1);
    t.add(0, 1, 1, {{2, 1.2F * kPi}});
    t.add(1, 2, 1, {{1, 1.2F * kPi}});
    const Solution s = solver->solve(t.problem(), {}, progress);
    EXPECT_FALSE(s.converged);
    EXPECT_EQ(s.iterations, SolveOptions().max_iterations);
    EXPECT_GT(s.residual, SolveOptions().tolerance);
    for (const vec3& l : s.radiance) {
        EXPECT_TRUE(std::isfinite(l.x));
        EXPECT_GE(l.x, 0);
    }
}

TEST_P(Solvers, ACycleOfAntiradianceThatSwingsIsDamped) {
    // Two patches that each stop 1.5 times what passes the other: undamped the antiradiance swings
    // between its two clamps for ever.
    HandMadeTransport t(3);
    t.source[1] = vec3(1);
    t.albedo[2] = t.albedo[3] = vec3(0.5F);
    t.add(0, 2, 1, {{1, 0.6F}, {3, -1.5F}});
    t.add(0, 3, 1, {{1, 0.6F}, {2, -1.5F}});
    const Solution s = solver->solve(t.problem(), {}, progress);
    EXPECT_TRUE(s.converged);
    // Two solutions hold one patch in the dark; the symmetric one is .6 / 2.5 for both.
    const float a = s.irradiance[2].x;
    const float b = s.irradiance[3].x;
    EXPECT_NEAR(a, std::max(0.0F, 0.6F - 1.5F * b), 1e-3F);
    EXPECT_NEAR(b, std::max(0.0F, 0.6F - 1.5F * a), 1e-3F);
}

TEST_P(Solvers, GrowingLightOfAnyMeshStaysFinite) {
    test::RandomTransportOptions options;
    options.gain = 4;
    const test::RandomTransport transport(options);
    const Solution s = solver->solve(transport.problem(), {}, progress);
    EXPECT_FALSE(s.converged);
    for (const vec3& l : s.radiance) {
        ASSERT_TRUE(std::isfinite(l.x) && std::isfinite(l.y) && std::isfinite(l.z));
        ASSERT_GE(std::min({l.x, l.y, l.z}), 0);
    }
}

}  // namespace
}  // namespace antiradiance
