// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "inspect/leaf_values.h"
#include "inspect/solved.h"
#include "support/tree_builder.h"

namespace antiradiance {
namespace {

float largest(const std::vector<vec3>& values) {
    float most = 0;
    for (const vec3& v : values)
        most = std::max(most, max_component(glm::abs(v)));
    return most;
}

float largest_difference(const std::vector<vec3>& a, const std::vector<vec3>& b) {
    std::vector<vec3> difference(a.size());
    std::ranges::transform(a, b, difference.begin(), std::minus{});
    return largest(difference);
}

// The same solution with other light over the links.
SolvedScene lit(SolvedScene solved, const std::function<vec3(const vec3&)>& change) {
    auto light = std::make_shared<SolvedScene::Light>(*solved.light);
    for (vec3& e : light->irradiance)
        e = change(e);
    solved.light = std::move(light);
    return solved;
}

TEST(Ancestor, LiesAsManyStepsAboveAsAskedFor) {
    const PatchTree tree = test::front_tree(test::office(), 1);
    for (const int level : {0, 1, 2, 3}) {
        for (const NodeId leaf : tree.leaves) {
            const NodeId above = ancestor(tree, leaf, level);
            const auto n = static_cast<std::size_t>(above);
            EXPECT_EQ(tree.depth[n],
                      std::max(0, tree.depth[static_cast<std::size_t>(leaf)] - level));
            EXPECT_TRUE(above <= leaf && leaf < tree.subtree_end[n]) << "not above it";
        }
    }
}

TEST(Ancestor, IsTheRootFromTheLevelCountOn) {
    const PatchTree tree = test::front_tree(test::office(), 1);
    const auto all_at_root = [&](int level) {
        return std::ranges::all_of(tree.leaves,
                                   [&](NodeId leaf) { return ancestor(tree, leaf, level) == 0; });
    };
    EXPECT_TRUE(all_at_root(level_count(tree) - 1));
    EXPECT_TRUE(all_at_root(level_count(tree) + 100));
    EXPECT_FALSE(all_at_root(level_count(tree) - 2));
    EXPECT_EQ(level_count(PatchTree{}), 0);
}

class OfEachVisibility : public testing::TestWithParam<Visibility> {
protected:
    const SolvedScene& solved = test::solved_office(GetParam());
    Progress progress;
};
INSTANTIATE_TEST_SUITE_P(LeafValues, OfEachVisibility,
                         testing::Values(Visibility::kExplicit, Visibility::kImplicit),
                         [](const auto& test_case) {
                             return test_case.param == Visibility::kExplicit ? "Explicit"
                                                                             : "Implicit";
                         });

TEST_P(OfEachVisibility, BinsAddUpToTheSolution) {
    std::vector<vec3> sum(solved.model->tree.size(), vec3(0));
    for (int bin = 0; bin < solved.links().bins.count(); ++bin)
        std::ranges::transform(sum, bin_irradiance(solved, bin, progress), sum.begin(),
                               std::plus{});
    const float scale = largest(solved.light->irradiance);
    ASSERT_GT(scale, 0);
    // The same sums in another order: rounding.
    EXPECT_LT(largest_difference(sum, regathered_irradiance(solved, progress)), 1e-5F * scale);
    // One pass more, and clamped: the solver's tolerance is what a pass changes at its end.
    for (vec3& e : sum)
        e = glm::max(vec3(0), e);
    EXPECT_LT(largest_difference(sum, solved.light->irradiance), SolveOptions{}.tolerance * scale);
}

TEST_P(OfEachVisibility, ResidualOfAConvergedSolutionIsBelowTheTolerance) {
    ASSERT_TRUE(solved.light->figures.converged);
    const std::vector<float> left = residuals(solved, progress);
    EXPECT_LT(std::ranges::max(left), SolveOptions{}.tolerance);
    EXPECT_GE(std::ranges::min(left), 0);
}

TEST_P(OfEachVisibility, ResidualAfterOnePassIsNotBelowTheTolerance) {
    Options options = test::coarse(GetParam());
    options.iterations = 1;
    // What the second bounce brings: some tenths of the first one in a room of albedo .7.
    EXPECT_GT(std::ranges::max(residuals(test::solve(test::office(), options), progress)), 0.01F);
}

TEST_P(OfEachVisibility, NoLeafDiffersFromItself) {
    for (const float difference : irradiance_differences(solved, solved, progress))
        EXPECT_EQ(difference, 0);
}

TEST(BinIrradiance, OfABinThatThereIsNotIsThatOfTheLast) {
    const SolvedScene& solved = test::solved_office(Visibility::kExplicit);
    Progress progress;
    const int last = solved.links().bins.count() - 1;
    EXPECT_EQ(bin_irradiance(solved, 1000, progress), bin_irradiance(solved, last, progress));
    EXPECT_EQ(bin_irradiance(solved, -1, progress), bin_irradiance(solved, 0, progress));
}

// Light that goes straight down arrives in one bin, and the shadow's antiradiance in the same.
TEST(BinIrradiance, BelowAPlateAddsUpToItsShadow) {
    const test::Plates plates(0);
    const SolvedScene& solved = plates.solved;
    Progress progress;
    const auto lowest = static_cast<std::size_t>(plates.leaf(test::Plates::kLowest, 1));
    const auto middle = static_cast<std::size_t>(plates.leaf(test::Plates::kMiddle, 1));
    const int down = solved.links().bins.bin(vec3(0, 0, -1));
    const std::vector<vec3> arriving = bin_irradiance(solved, down, progress);
    EXPECT_GT(arriving[middle].x, 0);
    // All that arrives from above was blocked; links from centre to centre are coarse.
    EXPECT_LT(arriving[lowest].x, 0.2F * arriving[middle].x);
}

TEST(IrradianceDifferences, AreRelativeToTheMeanOfAllLight) {
    const SolvedScene& solved = test::solved_office(Visibility::kExplicit);
    const SolvedScene twice = lit(solved, [](const vec3& e) { return 2.0F * e; });
    Progress progress;
    const std::vector<float> difference = irradiance_differences(twice, solved, progress);
    const PatchTree& tree = solved.model->tree;
    double added = 0;
    double area = 0;
    double all = 0;
    for (const NodeId leaf : tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        EXPECT_GE(difference[n], 0) << "brighter is positive";
        const double exposed = static_cast<double>(tree.area[n]) * tree.exposed[n];
        area += exposed;
        added += exposed * difference[n];
        all += exposed * luminance((*solved.leaf_direct)[n] + solved.light->irradiance[n]);
    }
    double indirect = 0;
    for (const NodeId leaf : tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        indirect += static_cast<double>(tree.area[n]) * tree.exposed[n] *
                    luminance(solved.light->irradiance[n]);
    }
    ASSERT_GT(indirect, 0);
    EXPECT_NEAR(added / area, indirect / all, 1e-4) << "the mean is the share of what was added";
}

// The leaves of one lie across those of the other.
TEST(IrradianceDifferences, OfOtherTreesCompareTheSamePlaces) {
    Options fine = test::coarse(Visibility::kExplicit);
    fine.max_patch_size = 0.4F;
    const auto dark = [](const vec3&) { return vec3(1); };
    const auto bright = [](const vec3&) { return vec3(3); };
    const SolvedScene coarse = lit(test::solved_office(Visibility::kExplicit), dark);
    const SolvedScene truth = lit(test::solve(test::office(), fine), bright);
    ASSERT_GT(truth.model->tree.leaves.size(), 2 * coarse.model->tree.leaves.size());
    Progress progress;
    const std::vector<float> difference = irradiance_differences(coarse, truth, progress);
    const float everywhere = difference[static_cast<std::size_t>(coarse.model->tree.leaves[0])];
    EXPECT_LT(everywhere, 0) << "darker is negative";
    for (const NodeId leaf : coarse.model->tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        if (coarse.model->tree.exposed[n] <= 0) continue;
        EXPECT_FLOAT_EQ(difference[n], everywhere);
    }
}

TEST(IrradianceDifferences, OfDifferentScenesAreRefused) {
    Progress progress;
    EXPECT_THROW(irradiance_differences(test::solved_office(Visibility::kExplicit),
                                        test::Plates(0).solved, progress),
                 std::invalid_argument);
}

TEST(LeafValues, OfASceneThatNoLightReachesAreNone) {
    Scene dark;
    test::add_box(dark, "Box", vec3(0), vec3(1), test::add_material(dark, vec3(0.5F)));
    const SolvedScene solved = test::solve(dark, test::coarse(Visibility::kImplicit));
    Progress progress;
    EXPECT_TRUE(bin_irradiance(solved, 0, progress).empty());
    EXPECT_TRUE(residuals(solved, progress).empty());
    EXPECT_TRUE(irradiance_differences(solved, solved, progress).empty());
}

}  // namespace
}  // namespace antiradiance
