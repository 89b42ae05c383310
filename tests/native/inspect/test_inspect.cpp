// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>

#include "inspect/inspect.h"
#include "inspect/leaf_values.h"
#include "inspect/solved.h"

namespace antiradiance {
namespace {

using test::solved_office;

constexpr int kWidth = 160, kHeight = 120;

Camera office_camera() {
    Scene scene;
    test::add_office_camera(scene, kWidth, kHeight);
    return scene.camera;
}

Inspection inspected(const SolvedScene& solved, const InspectOptions& options,
                     const SolvedScene* explicit_solution = nullptr) {
    Progress progress;
    return inspect(solved, options, explicit_solution, progress);
}

Picture drawn(const SolvedScene& solved, const Inspection& inspection, int samples_per_axis = 1) {
    Progress progress;
    return draw(solved, inspection, office_camera(), samples_per_axis, progress);
}

// Inspection in which every leaf has one colour.
Inspection plain(const SolvedScene& solved, const vec3& colour) {
    return {.colour = std::vector<vec3>(solved.model->tree.size(), colour)};
}

TEST(InspectModes, HaveNamesInTheirOrder) {
    ASSERT_EQ(inspect_modes().size(), 5U);
    EXPECT_EQ(inspect_modes()[static_cast<std::size_t>(InspectMode::kOff)].id, "OFF");
    EXPECT_EQ(inspect_modes()[static_cast<std::size_t>(InspectMode::kHierarchy)].id, "HIERARCHY");
    EXPECT_EQ(inspect_modes()[static_cast<std::size_t>(InspectMode::kExplicitDifference)].id,
              "EXPLICIT_DIFFERENCE");
}

TEST(Inspect, WithoutWhatItNeedsIsRefused) {
    const SolvedScene& solved = solved_office(Visibility::kImplicit);
    EXPECT_THROW(inspected(solved, {}), std::invalid_argument);
    EXPECT_THROW(inspected(solved, {.mode = InspectMode::kExplicitDifference}),
                 std::invalid_argument);
}

TEST(Hierarchy, LeavesShareAColourWhereTheyShareAnAncestor) {
    const SolvedScene& solved = solved_office(Visibility::kImplicit);
    const PatchTree& tree = solved.model->tree;
    for (const int level : {0, 2}) {
        const Inspection view =
            inspected(solved, {.mode = InspectMode::kHierarchy, .level = level});
        std::set<NodeId> patches;
        std::set<std::array<float, 3>> colours;
        for (const NodeId leaf : tree.leaves) {
            const vec3& c = view.colour[static_cast<std::size_t>(leaf)];
            EXPECT_EQ(view.patch[static_cast<std::size_t>(leaf)], ancestor(tree, leaf, level));
            patches.insert(view.patch[static_cast<std::size_t>(leaf)]);
            colours.insert({c.x, c.y, c.z});
            EXPECT_GT(max_component(c), 0.1F) << "visible";
            EXPECT_LE(max_component(c), 1);
        }
        EXPECT_EQ(colours.size(), patches.size()) << "a colour a patch";
        EXPECT_GT(patches.size(), 20U);
    }
}

TEST(Hierarchy, AtTheTopIsOneColour) {
    const SolvedScene& solved = solved_office(Visibility::kImplicit);
    const Inspection view = inspected(solved, {.mode = InspectMode::kHierarchy, .level = 1000});
    for (const NodeId leaf : solved.model->tree.leaves)
        EXPECT_EQ(view.colour[static_cast<std::size_t>(leaf)],
                  view.colour[static_cast<std::size_t>(solved.model->tree.leaves.front())]);
}

TEST(IncomingBin, IsGreyWhereLightArrivesAndRedWhereAntiradianceWins) {
    const SolvedScene& solved = solved_office(Visibility::kImplicit);
    Progress progress;
    const float solid_angle = solved.links().bins.mean_solid_angle();
    std::size_t positive = 0;
    std::size_t negative = 0;
    for (int bin = 0; bin < solved.links().bins.count(); bin += 8) {
        const Inspection view = inspected(solved, {.mode = InspectMode::kIncomingBin, .bin = bin});
        const std::vector<vec3> irradiance = bin_irradiance(solved, bin, progress);
        for (const NodeId leaf : solved.model->tree.leaves) {
            const auto n = static_cast<std::size_t>(leaf);
            const float radiance = luminance(irradiance[n]) / solid_angle;
            const bool wins = radiance < 0;
            ++(wins ? negative : positive);
            EXPECT_EQ(view.colour[n], wins ? vec3(-radiance, 0, 0) : vec3(radiance));
        }
    }
    EXPECT_GT(positive, 0U);
    EXPECT_GT(negative, 0U) << "no leaf has tested the red";
}

TEST(Residual, IsHotterTheMoreIsLeft) {
    Options once = test::coarse(Visibility::kExplicit);
    once.iterations = 1;
    const SolvedScene begun = test::solve(test::office(), once);
    const SolvedScene& done = solved_office(Visibility::kExplicit);
    const Inspection hot = inspected(begun, {.mode = InspectMode::kResidual});
    const Inspection cold = inspected(done, {.mode = InspectMode::kResidual});
    for (const NodeId leaf : done.model->tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        // Below 1e-4: red at most, as yellow begins at a third of six decades above 1e-6.
        EXPECT_EQ(cold.colour[n].y, 0);
        EXPECT_EQ(cold.colour[n].z, 0);
    }
    EXPECT_TRUE(std::ranges::any_of(hot.colour, [](const vec3& c) { return c.y > 0; }));
}

TEST(ExplicitDifference, IsWhiteAlikeRedBrighterAndBlueDarker) {
    const SolvedScene& truth = solved_office(Visibility::kExplicit);
    const auto changed = [&](float factor) {
        SolvedScene other = truth;
        auto light = std::make_shared<SolvedScene::Light>(*truth.light);
        for (vec3& e : light->irradiance)
            e *= factor;
        other.light = std::move(light);
        return inspected(other, {.mode = InspectMode::kExplicitDifference}, &truth);
    };
    const Inspection alike = changed(1);
    const Inspection brighter = changed(2);
    const Inspection darker = changed(0);
    std::size_t lit = 0;
    for (const NodeId leaf : truth.model->tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        EXPECT_EQ(alike.colour[n], vec3(1));
        if (truth.model->tree.exposed[n] <= 0) continue;
        ++lit;
        EXPECT_GT(brighter.colour[n].x, brighter.colour[n].z);
        EXPECT_GT(darker.colour[n].z, darker.colour[n].x);
    }
    EXPECT_GT(lit, 100U);
}

TEST(Draw, ShowsTheColourOfTheLeafInEachPixel) {
    const SolvedScene& solved = solved_office(Visibility::kExplicit);
    const vec3 colour(0.25F, 0.5F, 0.75F);  // exact in float, as is their mean
    const Picture picture = drawn(solved, plain(solved, colour), 2);
    ASSERT_EQ(picture.combined.size(), static_cast<std::size_t>(kWidth * kHeight));
    for (const vec4& pixel : picture.combined)
        EXPECT_EQ(pixel, vec4(colour, 1)) << "the office has walls all around";
}

TEST(Draw, ShadesShapes) {
    const SolvedScene& solved = solved_office(Visibility::kExplicit);
    Inspection view = plain(solved, vec3(1));
    view.shaded = true;
    float least = 1;
    float most = 0;
    for (const vec4& pixel : drawn(solved, view).combined) {
        least = std::min(least, pixel.x);
        most = std::max(most, pixel.x);
    }
    EXPECT_GE(least, 0.5F) << "a little, so that colours can still be told apart";
    EXPECT_LT(least, 0.75F) << "the floor is seen at less than half of the cosine";
    EXPECT_GT(most, 0.9F) << "the far wall is seen straight on";
}

TEST(Draw, OutlinesPatches) {
    const SolvedScene& solved = solved_office(Visibility::kExplicit);
    Inspection view = plain(solved, vec3(1));
    const std::vector<vec4> without = drawn(solved, view).combined;
    view.patch.resize(view.colour.size());
    for (std::size_t n = 0; n < view.patch.size(); ++n)
        view.patch[n] = static_cast<NodeId>(n);
    const auto dark = [&] {
        return std::ranges::count_if(drawn(solved, view).combined,
                                     [](const vec4& pixel) { return pixel.x < 0.5F; });
    };
    const auto of_leaves = dark();
    EXPECT_GT(of_leaves, kWidth) << "more than one line across the picture";
    EXPECT_LT(of_leaves, kWidth * kHeight / 2) << "patches are larger than their outlines";
    std::ranges::fill(view.patch, 0);
    EXPECT_EQ(dark(), 0) << "one patch has no inner outline";
}

TEST(Draw, NothingIsBlackOrTransparentAsTheFilm) {
    for (const bool transparent : {false, true}) {
        SolvedScene solved = test::Plates(0).solved;
        auto input = std::make_shared<StageInput>(*solved.input);
        input->film_transparent = transparent;
        input->scene.background = vec3(5);
        solved.input = std::move(input);
        const Picture picture = drawn(solved, plain(solved, vec3(1)));
        // The camera looks over the plates at the upper edge of the picture.
        EXPECT_EQ(picture.combined.back(), vec4(0, 0, 0, transparent ? 0 : 1));
    }
}

TEST(Draw, AnySceneThatNoLightReachesIsBlack) {
    Scene dark;
    test::add_box(dark, "Room", vec3(0), vec3(6, 4, 3), test::add_material(dark, vec3(0.5F)),
                  test::Facing::kInward);
    const SolvedScene solved = test::solve(dark, test::coarse(Visibility::kImplicit));
    for (const InspectMode mode : {InspectMode::kHierarchy, InspectMode::kIncomingBin,
                                   InspectMode::kResidual, InspectMode::kExplicitDifference}) {
        for (const vec4& pixel : drawn(solved, inspected(solved, {.mode = mode}, &solved)).combined)
            ASSERT_EQ(pixel, vec4(0, 0, 0, 1));
    }
}

}  // namespace
}  // namespace antiradiance
