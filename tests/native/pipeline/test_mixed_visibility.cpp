// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/mixed_visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "pipeline/compare_visibility.h"
#include "pipeline/lit_scene.h"
#include "pipeline/session.h"
#include "solve/row_normalisation.h"
#include "support/scenes.h"

namespace antiradiance {
namespace {

using test::LitScene;

Options coarse(Visibility visibility) {
    Options options;
    options.visibility = visibility;
    options.link_threshold = 0.05F;
    options.max_patch_size = 1;
    options.solver = SolverChoice::kCpu;
    return options;
}

MixedVisibility mix(const LitScene& lit, float budget, const VisibilityRays& rays = {}) {
    Progress progress;
    return mix_visibility(lit.problem(), lit.model.rays, lit.model.planes, {budget, rays},
                          progress);
}

TEST(MixedVisibility, NoRaysAreImplicit) {
    const LitScene lit(test::office(), coarse(Visibility::kImplicit));
    const MixedVisibility mixed = mix(lit, 0);
    EXPECT_EQ(mixed.rays, 0U);
    EXPECT_EQ(mixed.explicit_rows, 0U);
    EXPECT_EQ(mixed.implicit_rows, lit.model.links.segments.size());
    ASSERT_EQ(mixed.links.links.size(), lit.model.links.links.size());
    for (std::size_t l = 0; l < mixed.links.links.size(); ++l) {
        ASSERT_EQ(mixed.links.links[l].source, lit.model.links.links[l].source);
        ASSERT_EQ(mixed.links.links[l].form_factor, lit.model.links.links[l].form_factor);
    }
    EXPECT_TRUE(std::ranges::all_of(mixed.row_scale, [](float s) { return s == 1; }));
}

// Of the radiance of two solutions over the same tree: the largest difference over the mean.
double difference(const Solution& a, const Solution& b, const PatchTree& tree) {
    double most = 0;
    double mean = 0;
    for (const NodeId leaf : tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        most = std::max(
            most, static_cast<double>(max_component(glm::abs(a.radiance[n] - b.radiance[n]))));
        mean += static_cast<double>(max_component(b.radiance[n]));
    }
    return most / (mean / static_cast<double>(tree.leaves.size()));
}

// On the same link mesh: EXPLICIT by itself makes a coarser one where only - links ask for more.
TEST(MixedVisibility, AllRaysAreExplicit) {
    for (const DirectLightMode direct : {DirectLightMode::kExplicit, DirectLightMode::kImplicit}) {
        Options options = coarse(Visibility::kMixed);
        options.direct_light = direct;
        const LitScene lit(test::office(), options);
        const PatchTree& tree = lit.model.tree;
        Progress progress;
        const ExplicitLinks all = explicit_links(lit.model, visibility_rays(options), progress);
        const std::vector<float> row_scale =
            row_scales(tree, all.links, {}, lit.model.rays, lit.model.planes, progress);
        const MixedVisibility mixed = mix(lit, 1, visibility_rays(options));
        EXPECT_EQ(mixed.rays, all.rays);
        EXPECT_EQ(mixed.implicit_rows, 0U);
        EXPECT_EQ(mixed.links.antiradiance_count, 0U);
        EXPECT_EQ(mixed.links.radiance_count, all.links.radiance_count);
        // Both to the last digits: what is compared is the operators.
        const SolveOptions exact{.tolerance = 1e-7F, .max_iterations = 400};
        const auto solver = make_cpu_solver();
        const Solution a =
            solver->solve(lit.input.problem(tree, mixed.links, mixed.row_scale), exact, progress);
        const Solution b =
            solver->solve(lit.input.problem(tree, all.links, row_scale), exact, progress);
        EXPECT_LT(difference(a, b, tree), 1e-6);
    }
}

// A topmost row and the rows below it: all as they were, or all without - links.
TEST(MixedVisibility, DecidesWholeComponents) {
    const LitScene lit(test::office(), coarse(Visibility::kImplicit));
    const LinkSet& all = lit.model.links;
    const MixedVisibility mixed = mix(lit, 0.3F);
    ASSERT_GT(mixed.explicit_rows, 0U);
    ASSERT_GT(mixed.implicit_rows, 0U);
    for (int b = 0; b < all.bins.count(); ++b) {
        const auto bin = static_cast<std::size_t>(b);
        const auto minus_of = [bin](const LinkSet& set) {
            std::map<NodeId, int> count;
            for (std::uint32_t s = set.bin_segments[bin]; s < set.bin_segments[bin + 1]; ++s) {
                const Segment& row = set.segments[s];
                for (std::uint32_t l = row.begin; l < row.end; ++l)
                    count[row.receiver] += set.links[l].form_factor < 0 ? 1 : 0;
            }
            return count;
        };
        const std::map<NodeId, int> before = minus_of(all);
        std::map<NodeId, int> after = minus_of(mixed.links);
        for (auto top = before.begin(); top != before.end();) {
            const NodeId end = lit.model.tree.subtree_end[static_cast<std::size_t>(top->first)];
            bool any_kept = false;
            bool any_gone = false;
            for (; top != before.end() && top->first < end; ++top) {
                if (top->second == 0) continue;
                any_kept = any_kept || after[top->first] == top->second;
                any_gone = any_gone || after[top->first] == 0;
                ASSERT_TRUE(after[top->first] == top->second || after[top->first] == 0);
            }
            ASSERT_FALSE(any_kept && any_gone) << "bin " << b;
        }
    }
}

TEST(MixedVisibility, MoreRaysNeverErrMore) {
    constexpr float kBudgets[] = {0, 0.1F, 0.25F, 0.5F, 0.75F, 1};
    std::vector<Options> ways;
    for (const float budget : kBudgets) {
        ways.push_back(coarse(Visibility::kMixed));
        ways.back().ray_budget = budget;
    }
    Progress progress;
    const ReferenceRays reference{visibility_rays(ways.front()), true};
    for (const Scene& scene : {test::office(), test::corridor()}) {
        const std::vector<VisibilityError> errors =
            compare_visibility(scene, ways, reference, progress);
        EXPECT_GT(errors.front().relative_rms, 0.005);
        for (std::size_t i = 1; i < errors.size(); ++i) {
            EXPECT_LE(errors[i].relative_rms, errors[i - 1].relative_rms) << kBudgets[i];
            EXPECT_LE(
                static_cast<double>(errors[i].rays),
                static_cast<double>(kBudgets[i]) * static_cast<double>(errors.back().rays) + 1);
        }
        EXPECT_LT(errors.back().relative_rms, 1e-6);
    }
}

TEST(MixedVisibility, ComposesWithPruningInARender) {
    Options options = coarse(Visibility::kMixed);
    options.pruning = PruneMethod::kConservative;
    options.ray_budget = 0.5F;
    Session session;
    Progress progress;
    const Report half = session.render(test::office(), options, false, 0, progress).report;
    for (const std::string& warning : half.warnings)
        EXPECT_EQ(warning.find("Pruning"), std::string::npos) << warning;
    EXPECT_GT(half.pruning.removed_radiance, 0U);
    EXPECT_EQ(half.visibility.mode, "MIXED");
    EXPECT_GT(half.visibility.explicit_rows, 0U);
    EXPECT_GT(half.visibility.implicit_rows, 0U);
    options.ray_budget = 1;
    const Report all = session.render(test::office(), options, false, 0, progress).report;
    EXPECT_EQ(all.visibility.implicit_rows, 0U);
    EXPECT_EQ(all.links.antiradiance, 0U);
    EXPECT_GT(all.visibility.rays, half.visibility.rays);
    EXPECT_LE(static_cast<double>(half.visibility.rays),
              0.5 * static_cast<double>(all.visibility.rays) + 1);
    const std::vector<std::pair<std::string, std::string>> stages{
        {"model", "kept"}, {"pruning", "kept"},   {"direct_light", "kept"}, {"transport", "run"},
        {"solve", "run"},  {"evaluation", "run"}, {"display", "run"}};
    EXPECT_EQ(all.stages, stages);
}

// Where shadow rays bring the direct light, the links out of a luminous panel carry nothing.
TEST(DarkLinks, LeaveThePictureAsItIs) {
    Scene scene = test::office();
    test::add_office_camera(scene, 24, 18);
    Options options = coarse(Visibility::kImplicit);
    options.display = DisplayMode::kPatches;
    Session session;
    Progress progress;
    const RenderResult all = session.render(scene, options, false, 0, progress);
    options.remove_dark_links = true;
    const RenderResult lit = session.render(scene, options, false, 0, progress);
    EXPECT_GT(lit.report.pruning.removed_dark, 0U);
    EXPECT_EQ(lit.report.pruning.removed_dark + lit.report.links.total, all.report.links.total);
    for (std::size_t i = 0; i < all.picture.combined.size(); ++i) {
        for (int k = 0; k < 3; ++k)
            ASSERT_NEAR(lit.picture.combined[i][k], all.picture.combined[i][k],
                        1e-4F * all.picture.combined[i][k]);
    }
}

}  // namespace
}  // namespace antiradiance
