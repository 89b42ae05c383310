// SPDX-License-Identifier: GPL-3.0-or-later
// Blocking planes through the whole pipeline: where light does not get, and where it still does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include "pipeline/evaluate_blockers.h"
#include "pipeline/lit_scene.h"
#include "pipeline/session.h"
#include "support/scene_builder.h"
#include "support/scenes.h"
#include "support/tree_builder.h"

namespace antiradiance {
namespace {

using test::LitScene;

constexpr vec3 kSize{8, 4, 2.7F};  // m, of both rooms together
constexpr float kMiddle = 4;       // m, of the wall between them, .2 thick

// A red lamp in the left room, a blue one in the right: red light on the right is a leak.
Scene two_sealed_rooms() {
    Scene scene;
    const int white = test::add_material(scene, vec3(0.7F));
    test::add_box(scene, "Rooms", vec3(0), kSize, white, test::Facing::kInward);
    test::add_box(scene, "Wall", {kMiddle - 0.1F, 0, 0}, {kMiddle + 0.1F, kSize.y, kSize.z}, white);
    test::add_point_lamp(scene, {2, 2, 2}, {200, 0, 0});
    test::add_point_lamp(scene, {6, 2, 2}, {0, 0, 50});
    return scene;
}

void add_middle_plane(Scene& scene) {
    test::add_plane(scene, "Middle", {kMiddle, 0, 0}, {0, kSize.y, 0}, {0, 0, kSize.z});
}

Options options_of(Visibility visibility) {
    Options options;
    options.visibility = visibility;
    options.max_patch_size = 0.8F;
    options.solver = SolverChoice::kCpu;
    return options;
}

constexpr Visibility kAllVisibilities[] = {Visibility::kImplicit, Visibility::kMixed,
                                           Visibility::kExplicit, Visibility::kDiscrete};

RenderResult render(const Scene& scene, const Options& options) {
    Progress progress;
    return Session().render(scene, options, false, 0, progress);
}

nlohmann::json report_of(const RenderResult& result) {
    return nlohmann::json::parse(result.report.to_json());
}

bool contains(const std::vector<std::string>& texts, const std::string& part) {
    return std::ranges::any_of(
        texts, [&](const std::string& text) { return text.find(part) != std::string::npos; });
}

// Mean red irradiance on the right of the wall over that on its left.
double leak(const Scene& scene, Visibility visibility) {
    const LitScene lit(scene, options_of(visibility));
    Progress progress;
    const Solution solution = make_cpu_solver()->solve(lit.problem(), {}, progress);
    double red[2] = {0, 0};
    double area[2] = {0, 0};
    for (const NodeId leaf : lit.model.tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        const int side = lit.model.tree.center[n].x > kMiddle ? 1 : 0;
        red[side] +=
            static_cast<double>(std::abs(solution.irradiance[n].x) * lit.model.tree.area[n]);
        area[side] += static_cast<double>(lit.model.tree.area[n]);
    }
    EXPECT_GT(area[1], 20) << "the right room takes part";
    return red[1] / area[1] / (red[0] / area[0]);
}

TEST(Blockers, NothingLeaksThroughAPlane) {
    const Scene open = two_sealed_rooms();
    Scene blocked = open;
    add_middle_plane(blocked);
    const double without = leak(open, Visibility::kImplicit);
    std::cout << "leak without the plane: " << without << "\n";
    EXPECT_GT(without, 1e-3) << "else there is nothing to block";
    for (const Visibility visibility : {Visibility::kImplicit, Visibility::kExplicit})
        EXPECT_EQ(leak(blocked, visibility), 0);
}

// Pictures of the right room's far wall: lit in blue, not in red.
TEST(Blockers, TheOtherSideIsDarkInEveryDisplayMode) {
    Scene scene = two_sealed_rooms();
    scene.has_camera = true;
    Camera& c = scene.camera;
    c.to_world = glm::inverse(glm::lookAt(vec3(4.5F, 2, 1.3F), vec3(8, 2, 1.3F), vec3(0, 0, 1)));
    c.left = c.bottom = -0.3F;
    c.right = c.top = 0.3F;
    c.width = c.x1 = c.height = c.y1 = 12;
    Scene blocked = scene;
    add_middle_plane(blocked);

    std::vector<Options> ways;
    for (const Visibility visibility : kAllVisibilities)
        ways.push_back(options_of(visibility));
    Options implicit = options_of(Visibility::kImplicit);
    implicit.display = DisplayMode::kPatches;
    ways.push_back(implicit);
    implicit.display = DisplayMode::kSplatting;
    ways.push_back(implicit);
    implicit.display = DisplayMode::kFinalShooting;
    for (const ShootingVisibility shot :
         {ShootingVisibility::kRays, ShootingVisibility::kAntiradiance}) {
        for (const ShootingLevel level :
             {ShootingLevel::kCut, ShootingLevel::kLeaves, ShootingLevel::kParents}) {
            for (const int interleave : {1, 2}) {
                implicit.shooting_visibility = shot;
                implicit.shooting_level = level;
                implicit.interleave = interleave;
                ways.push_back(implicit);
            }
        }
    }
    Options pruned = implicit;
    pruned.pruning = PruneMethod::kConservative;
    ways.push_back(pruned);
    for (std::size_t i = 0; i < ways.size(); ++i) {
        const Picture picture = render(blocked, ways[i]).picture;
        for (const vec4& pixel : picture.combined) {
            ASSERT_EQ(pixel.x, 0) << "way " << i;
            ASSERT_GT(pixel.z, 0) << "way " << i;
        }
    }
    const Picture leaking = render(scene, options_of(Visibility::kImplicit)).picture;
    EXPECT_TRUE(std::ranges::any_of(leaking.combined, [](const vec4& p) { return p.x > 0; }));
}

// A box of two cubes, of which a plane makes two: of the light that leaves a cube's walls, the
// share that meets the plane's square is 1 of 5 (reciprocity), and arrives nowhere.
TEST(Blockers, RowsAreNotNormalisedBackToWhole) {
    Scene scene;
    test::add_box(scene, "Box", vec3(0), {2, 1, 1}, test::add_material(scene, vec3(0), vec3(1)),
                  test::Facing::kInward);
    test::add_plane(scene, "Plane", {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    for (const Visibility visibility : {Visibility::kImplicit, Visibility::kExplicit}) {
        Options options = options_of(visibility);
        options.direct_light = DirectLightMode::kImplicit;
        options.max_patch_size = 0.25F;
        options.link_threshold = 0.01F;
        const LitScene lit(scene, options);
        Progress progress;
        const Solution solution = make_cpu_solver()->solve(lit.problem(), {}, progress);
        const vec3 mean = test::area_mean(lit.model.tree, test::front_leaves(lit.model.tree),
                                          solution.irradiance);
        EXPECT_NEAR(mean.x / kPi, 0.8F, 0.01F);
    }
}

// The corridor's wall beside a door: planes around the opening take no light through it away.
TEST(Blockers, ADoorStaysOpen) {
    Scene scene = test::corridor();
    for (const float y : {1.95F, 3.05F}) {
        test::add_plane(scene, "Wall", {0, y, 0}, {1.5F, 0, 0}, {0, 0, 2.7F});
        test::add_plane(scene, "Wall", {2.4F, y, 0}, {3.1F, 0, 0}, {0, 0, 2.7F});
        test::add_plane(scene, "Wall", {6.4F, y, 0}, {1.6F, 0, 0}, {0, 0, 2.7F});
    }
    Options options = options_of(Visibility::kImplicit);
    options.max_patch_size = 0.9F;
    Progress progress;
    const BlockerEvaluation e =
        evaluate_blockers(scene, options, {.rays = 16, .all_links = true, .light = true}, progress);
    LinkCount cut;
    LinkCount occluded_cut;
    std::size_t wrongly_cut = 0;
    for (const auto& plane : e.per_plane) {
        EXPECT_GT(plane.cut.total(), 0U);
        cut += plane.cut;
        occluded_cut += plane.occluded_cut;
        wrongly_cut += plane.wrongly_cut;
    }
    std::cout << cut.total() << " of " << e.links.total() << " links cut, " << occluded_cut.radiance
              << " of " << e.occluded->radiance << " occluded + links, wrongly " << wrongly_cut
              << " of " << cut.radiance << "; error " << e.without_planes->relative_rms << " -> "
              << e.with_planes->relative_rms << "\n";
    EXPECT_EQ(wrongly_cut, 0U);
    EXPECT_GT(occluded_cut.radiance, e.occluded->radiance / 2);
    EXPECT_LE(e.with_planes->relative_rms, e.without_planes->relative_rms);
}

TEST(Blockers, AQuickEvaluationAgreesWithAWholeOne) {
    Scene scene = two_sealed_rooms();
    add_middle_plane(scene);
    const Options options = options_of(Visibility::kExplicit);
    Progress progress;
    const BlockerEvaluation counted = evaluate_blockers(scene, options, {.rays = 0}, progress);
    const BlockerEvaluation traced = evaluate_blockers(scene, options, {.rays = 16}, progress);
    const BlockerEvaluation whole =
        evaluate_blockers(scene, options, {.rays = 16, .all_links = true, .light = true}, progress);
    ASSERT_EQ(counted.per_plane.size(), 1U);
    for (const BlockerEvaluation* e : {&counted, &traced, &whole})
        EXPECT_EQ(e->per_plane[0].cut.total(), counted.per_plane[0].cut.total());
    EXPECT_GT(counted.links.antiradiance, 0U) << "of IMPLICIT, whatever the options say";
    EXPECT_EQ(counted.per_plane[0].occluded_cut.total(), 0U);
    // A floor patch below the wall is seen from both rooms.
    EXPECT_GE(traced.per_plane[0].occluded_cut.radiance,
              traced.per_plane[0].cut.radiance * 99 / 100);
    EXPECT_EQ(traced.per_plane[0].occluded_cut.total(), whole.per_plane[0].occluded_cut.total());
    EXPECT_EQ(traced.per_plane[0].wrongly_cut, 0U);
    EXPECT_FALSE(traced.occluded.has_value());
    EXPECT_GE(whole.occluded->radiance, whole.per_plane[0].occluded_cut.radiance);
}

TEST(Blockers, APlaneInTheOpenIsFoundWrong) {
    Scene scene = two_sealed_rooms();
    test::add_plane(scene, "In the open", {2, 0, 0}, {0, 2, 0}, {0, 0, 2});
    Progress progress;
    const BlockerEvaluation e =
        evaluate_blockers(scene, options_of(Visibility::kImplicit), {.rays = 4}, progress);
    EXPECT_GT(e.per_plane[0].wrongly_cut, e.per_plane[0].cut.radiance / 2);
}

TEST(Blockers, PlanesThatHelpAreToldApart) {
    Scene scene = two_sealed_rooms();
    test::add_plane(scene, "In the open", {2, 0, 0}, {0, 4, 0}, {0, 0, 2.7F});
    add_middle_plane(scene);
    Progress progress;
    const BlockerEvaluation e = evaluate_blockers(scene, options_of(Visibility::kImplicit),
                                                  {.rays = 0, .light = true}, progress);
    EXPECT_FALSE(e.per_plane[0].helps);
    EXPECT_TRUE(e.per_plane[1].helps);
}

TEST(Blockers, ThePlaneInTheWrongPlaceIsNamed) {
    Scene scene = two_sealed_rooms();
    add_middle_plane(scene);
    // Below the ceiling and wider than the rooms: hardly a link of it is left.
    test::add_plane(scene, "Lid", {-1, -1, 2.4F}, {10, 0, 0}, {0, 6, 0});
    for (const Visibility visibility : {Visibility::kExplicit, Visibility::kImplicit}) {
        const auto warnings = render(scene, options_of(visibility)).report.warnings;
        EXPECT_TRUE(contains(warnings, "Blocking plane 'Lid': no wall is in the way of"));
        EXPECT_FALSE(contains(warnings, "'Middle'"));
    }
}

TEST(Blockers, TheReportCountsThemByPlane) {
    Scene scene = two_sealed_rooms();
    add_middle_plane(scene);
    test::add_plane(scene, "Aside", {-5, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const auto json = report_of(render(scene, options_of(Visibility::kImplicit)))["blockers"];
    EXPECT_EQ(json["planes"], 2);
    EXPECT_EQ(json["per_plane"][0]["name"], "Middle");
    EXPECT_EQ(json["per_plane"][1]["links_cut"], 0);
    EXPECT_GT(json["radiance_cut"].get<int>(), 1000);
    EXPECT_GT(json["antiradiance_cut"].get<int>(), 1000);
    EXPECT_EQ(json["links_cut"].get<int>(),
              json["radiance_cut"].get<int>() + json["antiradiance_cut"].get<int>());
    EXPECT_EQ(json["per_plane"][0]["links_cut"], json["links_cut"]);
    EXPECT_GT(json["seconds"].get<double>(), 0);

    const auto none = report_of(render(two_sealed_rooms(), options_of(Visibility::kImplicit)));
    EXPECT_EQ(none["blockers"]["planes"], 0);
    EXPECT_EQ(none["blockers"]["links_cut"], 0);
}

TEST(Blockers, ThePlaneThatMovesMakesNewLinks) {
    Scene scene = two_sealed_rooms();
    add_middle_plane(scene);
    const Options options = options_of(Visibility::kExplicit);
    Session session;
    Progress progress;
    const auto stages_of = [&](const Scene& next) {
        return nlohmann::json::parse(
            session.render(next, options, false, 0, progress).report.to_json())["stages"];
    };
    static_cast<void>(stages_of(scene));
    EXPECT_EQ(stages_of(scene)["model"], "kept");
    for (vec3& p : scene.blockers[0].positions)
        p.x -= 0.01F;
    EXPECT_EQ(stages_of(scene)["model"], "run");
}

}  // namespace
}  // namespace antiradiance
