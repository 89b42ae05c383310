// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes on which antiradiance has diverged (algorithm.md "It can diverge"), and agreement of the
// back ends on real link meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/lit_scene.h"
#include "support/scenes.h"
#include "support/solvers.h"

namespace antiradiance {
namespace {

using test::LitScene;

using Stability = test::OnEachSolver;
INSTANTIATE_TEST_SUITE_P(, Stability, test::each_solver(), test::solver_name);

Options implicit_options(int bins, DirectLightMode direct, float max_patch_size = 1) {
    Options options;
    options.visibility = Visibility::kImplicit;
    options.direct_light = direct;
    options.direction_bins = bins;
    options.max_patch_size = max_patch_size;
    options.link_threshold = 0.05F;
    return options;
}

// Relative change below 1e-3 within 16 bounces; never NaN, never negative, never brighter than the
// lamp.
void expect_stable(Solver& solver, const LitScene& lit) {
    Progress progress;
    const Solution s =
        solver.solve(lit.problem(), {.tolerance = 1e-3F, .max_iterations = 16}, progress);
    std::cout << lit.model.tree.leaves.size() << " leaves, " << lit.model.links.links.size()
              << " links: residual " << s.residual << " after " << s.iterations << " passes\n";
    EXPECT_TRUE(s.converged) << s.residual;
    test::expect_light(s.radiance);
    test::expect_light(s.irradiance);
    float most_sent = 0;
    for (const vec3& l : lit.input.source)
        most_sent = std::max(most_sent, max_component(l));
    float most = 0;
    for (const vec3& l : s.radiance)
        most = std::max(most, max_component(l));
    EXPECT_GT(most_sent, 0);
    EXPECT_LT(most, 2 * most_sent);
}

TEST_P(Stability, BuriedFloor) {
    for (const DirectLightMode direct : {DirectLightMode::kExplicit, DirectLightMode::kImplicit}) {
        const LitScene lit(test::office(), implicit_options(128, direct));
        const std::vector<float>& exposed = lit.model.tree.exposed;
        ASSERT_LE(*std::min_element(exposed.begin(), exposed.end()), 0) << "nothing is buried";
        expect_stable(*solver, lit);
    }
}

TEST_P(Stability, FiveHundredAndTwelveBins) {
    for (const DirectLightMode direct : {DirectLightMode::kExplicit, DirectLightMode::kImplicit}) {
        const LitScene lit(test::corridor(), implicit_options(512, direct, 2));
        expect_stable(*solver, lit);
    }
}

struct Difference {
    double largest = 0;  // over the largest value, as residuals are
    double rms = 0;      // over the mean, weighted by area
};
Difference difference(const PatchTree& tree, const std::vector<vec3>& a,
                      const std::vector<vec3>& b) {
    double squares = 0, mean = 0, area = 0, off = 0, most = 0;
    for (const NodeId leaf : tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        const double x = a[n].x;
        const double y = b[n].x;
        squares += tree.area[n] * (x - y) * (x - y);
        mean += tree.area[n] * y;
        area += tree.area[n];
        off = std::max(off, std::abs(x - y));
        most = std::max(most, y);
    }
    return {off / most, std::sqrt(squares / area) / (mean / area)};
}

TEST(BackEnds, AgreeOnRealLinkMeshes) {
    std::string why_not;
    const std::unique_ptr<Solver> gl = make_gl_solver(why_not);
    if (!gl) GTEST_SKIP() << why_not;
    const std::unique_ptr<Solver> cpu = make_cpu_solver();
    for (const Visibility visibility : {Visibility::kExplicit, Visibility::kImplicit}) {
        Options options = implicit_options(128, DirectLightMode::kImplicit);
        options.visibility = visibility;
        const LitScene lit(test::office(), options);
        for (const int passes : {1, 5, 0}) {
            SCOPED_TRACE(testing::Message()
                         << "visibility " << static_cast<int>(visibility) << ", passes " << passes);
            Progress progress;
            const SolveOptions solve{.iterations = passes};
            const Solution a = cpu->solve(lit.problem(), solve, progress);
            const Solution b = gl->solve(lit.problem(), solve, progress);
            const Difference off = difference(lit.model.tree, b.irradiance, a.irradiance);
            std::cout << "passes " << a.iterations << " CPU, " << b.iterations
                      << " OpenGL, difference " << off.largest << ", RMS " << off.rms << "\n";
            EXPECT_LT(off.largest, passes > 0 ? 1e-5 : 1e-3);
            EXPECT_LT(off.rms, passes > 0 ? 1e-5 : 1e-3);
            if (passes == 0) {
                EXPECT_TRUE(a.converged);
                EXPECT_TRUE(b.converged);
            }
        }
    }
}

}  // namespace
}  // namespace antiradiance
