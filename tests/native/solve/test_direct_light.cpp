// SPDX-License-Identifier: GPL-3.0-or-later
// Shadows, emissive meshes, many emitters, leaves.
#include "solve/direct_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <iostream>

#include "base/error.h"
#include "base/random.h"
#include "support/scene_builder.h"
#include "support/tree_builder.h"

namespace antiradiance {
namespace {

const vec3 kUp(0, 0, 1);
const vec3 kX(1, 0, 0);
const vec3 kY(0, 1, 0);

struct Stage {
    explicit Stage(const Scene& s, DirectLightMode mode = DirectLightMode::kExplicit)
        : scene(s), rays(scene), light(scene, rays, mode, progress) {}
    // Mean over a horizontal square around p.
    [[nodiscard]] vec3 at(const vec3& p, const vec3& n = kUp, float size = 0, int samples = 64,
                          std::uint32_t seed = 1) const {
        std::vector<SurfacePoint> points;
        for (std::uint32_t i = 0; i < 16; ++i) {
            const vec2 d = (r2_sample(i, 3) - 0.5F) * size;
            points.push_back({p + vec3(d, 0), n, n});
        }
        return light.irradiance(points, {.samples = samples}, seed);
    }
    Progress progress;
    Scene scene;
    RayScene rays;
    DirectLight light;
};

Lamp point_lamp(const vec3& position, float watts_per_sr, float radius = 0) {
    Lamp lamp;
    lamp.name = "lamp";
    lamp.power = vec3(watts_per_sr * 4 * kPi);
    lamp.radius = radius;
    lamp.to_world = glm::translate(mat4(1), position);
    return lamp;
}

// Factor from a unit square at height h, with a corner above the point.
double corner_factor(double h) {
    const double x = 1 / h;
    const double r = std::sqrt(1 + x * x);
    return 2 * x / r * std::atan(x / r) / (2 * kPi);
}

TEST(DirectLight, nothing_to_give) {
    Scene scene;
    test::add_quad(scene, "floor", vec3(0), kX, kY, kNone);
    const Stage stage(scene);
    EXPECT_FALSE(stage.light.any());
    EXPECT_EQ(stage.at(vec3(0)), vec3(0));
}

TEST(DirectLight, a_blocker_casts_a_sharp_shadow_of_a_point) {
    Scene scene;
    // Blocker over x < 0 at half height: the shadow's edge lies at x = 0.
    test::add_quad(scene, "blocker", vec3(-9, -5, 1), 9.0F * kX, 10.0F * kY, kNone);
    scene.lamps.push_back(point_lamp(vec3(0, 0, 2), 1));
    const Stage stage(scene);
    EXPECT_EQ(stage.at(vec3(-0.01F, 0, 0)), vec3(0));
    EXPECT_NEAR(stage.at(vec3(0.01F, 0, 0)).x, 0.25F, 1e-4F);
}

TEST(DirectLight, a_blocker_that_covers_half_a_lamp_halves_its_light) {
    Scene scene;
    test::add_quad(scene, "blocker", vec3(-9, -5, 1), 9.0F * kX, 10.0F * kY, kNone);
    Lamp area;
    area.type = LampType::kArea;
    area.name = "area";
    area.power = vec3(4);
    area.to_world = glm::translate(mat4(1), vec3(0, 0, 2));
    Scene sun_scene = scene;
    Scene sphere_scene = scene;
    scene.lamps.push_back(area);
    const float half_area = static_cast<float>(kPi * 4 * corner_factor(4)) / 2;
    // By symmetry, half of the lamp is hidden below its centre; 1024 rays err by below 1 %.
    EXPECT_NEAR(Stage(scene).at(vec3(0)).x, half_area, 0.01F * half_area);

    sphere_scene.lamps.push_back(point_lamp(vec3(0, 0, 2), 1, 0.3F));
    EXPECT_NEAR(Stage(sphere_scene).at(vec3(0)).x, 0.125F, 0.01F * 0.125F);

    Lamp sun;
    sun.type = LampType::kSun;
    sun.power = vec3(1);
    sun.sun_angle = 0.1F;
    sun_scene.lamps.push_back(sun);
    EXPECT_NEAR(Stage(sun_scene).at(vec3(0)).x, 0.5F, 0.005F);
    EXPECT_EQ(Stage(sun_scene).at(vec3(-0.1F, 0, 0)).x, 0);
    EXPECT_NEAR(Stage(sun_scene).at(vec3(0.1F, 0, 0)).x, 1, 1e-5F);
}

TEST(DirectLight, unshadowed_light_has_no_noise) {
    Scene scene;
    const int m = test::add_material(scene, vec3(0), vec3(1));
    test::add_quad(scene, "emitter", vec3(0, 0, 0.5F), kX, kY, m);
    const Stage stage(scene);
    const double expected = kPi * corner_factor(0.5);
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        EXPECT_NEAR(stage.at(vec3(0), kUp, 0, 16, seed).x, expected, 1e-5 * expected);
    }
}

// Half of a lamp hidden, by few rays and by many: what is left is noise. A pixel without a shadow's
// edge is exact with the fewest rays.
TEST(DirectLight, samples_set_the_noise_of_a_penumbra) {
    Scene scene;
    test::add_quad(scene, "blocker", vec3(-9, -5, 1), 9.0F * kX, 10.0F * kY, kNone);
    scene.lamps.push_back(point_lamp(vec3(0, 0, 2), 1, 0.3F));
    const Stage stage(scene);
    const auto deviation = [&](int samples) {
        constexpr std::uint32_t kSeeds = 64;
        double squares = 0;
        for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
            const double error = stage.at(vec3(0), kUp, 0, samples, seed).x / 0.125 - 1;
            squares += error * error / kSeeds;
        }
        return std::sqrt(squares);
    };
    const double few = deviation(4);
    const double standard = deviation(16);
    const double many = deviation(256);
    std::cout << "noise with 4, 16, 256 samples: " << few << ", " << standard << ", " << many
              << "\n";
    EXPECT_LT(standard, 0.03);  // about what an eye sees
    EXPECT_LT(standard, few);
    EXPECT_LT(many, standard / 3);
    EXPECT_NEAR(stage.at(vec3(1, 0, 0), kUp, 0, 4).x, 2 / std::pow(5.0, 1.5), 1e-5);
}

TEST(DirectLight, an_emissive_face_shines_from_both_sides) {
    Scene scene;
    const int m = test::add_material(scene, vec3(0), vec3(1, 2, 3));
    test::add_quad(scene, "emitter", vec3(0), kX, kY, m);  // front up
    const Stage stage(scene);
    const auto expected = static_cast<float>(kPi * corner_factor(1));
    EXPECT_NEAR(stage.at(vec3(0, 0, 1), -kUp).x, expected, 1e-5F);
    EXPECT_NEAR(stage.at(vec3(0, 0, -1), kUp).z, 3 * expected, 1e-5F);
}

TEST(DirectLight, a_triangle_counts_like_its_half_of_the_square) {
    Scene scene;
    const int m = test::add_material(scene, vec3(0), vec3(1));
    // Symmetric halves of a square about the diagonal through the point below its corner.
    test::add_polygon(scene, "triangle", {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}}, m);
    EXPECT_NEAR(Stage(scene).at(vec3(0)).x, kPi * corner_factor(1) / 2, 1e-5);
}

TEST(DirectLight, agrees_with_cycles_on_an_emissive_mesh) {
    // Cycles 3.4.1, 1024 samples, no bounces.
    Scene scene;
    const int m = test::add_material(scene, vec3(0), vec3(5));
    test::add_polygon(scene, "emitter",
                      {{-.5F, -.5F, 2}, {.5F, -.5F, 2}, {.5F, .5F, 2}, {-.5F, .5F, 2}}, m);
    const Stage stage(scene);
    // Means over 3 x 3 pixels of 1/8 m around pixel (32,32), (20,40) and (44,28) of |x|,|y| < 4.
    EXPECT_NEAR(stage.at({0.0625F, 0.0625F, 0}, kUp, 0.375F).x, 1.13907F, 0.005F * 1.139F);
    EXPECT_NEAR(stage.at({-1.4375F, 1.0625F, 0}, kUp, 0.375F).x, 0.39251F, 0.01F * 0.3925F);
    EXPECT_NEAR(stage.at({1.5625F, -0.4375F, 0}, kUp, 0.375F).x, 0.45844F, 0.01F * 0.4584F);
}

TEST(DirectLight, textured_emission_weighs_every_part) {
    Scene scene;
    Texture t;
    t.name = "half";
    t.width = 64;
    t.height = 1;
    for (int i = 0; i < 64; ++i)
        t.pixels.emplace_back(vec3(i < 32 ? 1.0F : 0.0F), 1);
    scene.textures.push_back(t);
    const int m = test::add_material(scene, vec3(0), vec3(2));
    scene.materials[0].emission_texture = 0;
    test::add_quad(scene, "screen", vec3(-1, 0, 1), 2.0F * kX, kY, m);
    const Stage stage(scene);
    // Lit half: the unit square over x in [-1, 0]; its corner is above the origin. Two columns of
    // the texture blend into each other: 1.5 % of the width, and cells of 1/16 average over them.
    const auto lit = static_cast<float>(2 * kPi * corner_factor(1));
    EXPECT_NEAR(stage.at(vec3(0), kUp, 0, 64).x, lit, 0.03F * lit);
    // Below the dark half's far corner there is less light than below the lit half's.
    EXPECT_GT(stage.at(vec3(-1, 0, 0)).x, 1.5F * stage.at(vec3(1, 0, 0)).x);
}

TEST(DirectLight, implicit_mode_leaves_surfaces_to_the_links) {
    Scene scene;
    const int m = test::add_material(scene, vec3(0), vec3(1));
    test::add_quad(scene, "emitter", vec3(0, 0, 2), kX, kY, m);
    Lamp area;
    area.type = LampType::kArea;
    area.power = vec3(1);
    area.to_world = glm::translate(mat4(1), vec3(0, 0, 2));
    scene.lamps.push_back(area);
    EXPECT_FALSE(Stage(scene, DirectLightMode::kImplicit).light.any());
    scene.lamps.push_back(point_lamp(vec3(0, 0, 1), 1));
    EXPECT_NEAR(Stage(scene, DirectLightMode::kImplicit).at(vec3(0)).x, 1, 1e-5F);
}

TEST(DirectLight, many_emitters_add_up) {
    // 2000 small lamps on a wall-sized grid against their sum, one by one.
    Scene scene;
    test::add_quad(scene, "far away", vec3(0, 0, -50), kX, kY, kNone);
    std::vector<Lamp> lamps;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const vec2 p = (r2_sample(i, 9) - 0.5F) * 20.0F;
        lamps.push_back(
            point_lamp(vec3(p, 2 + to_unit_float(hash_u32(i))), to_unit_float(hash_u32(~i))));
    }
    scene.lamps = lamps;
    const Stage stage(scene);
    for (const vec3& p : {vec3(0), vec3(4, -3, 0), vec3(12, 12, 0)}) {
        double expected = 0;
        for (const Lamp& lamp : lamps) {
            const vec3 to = vec3(lamp.to_world[3]) - p;
            const float d = glm::length(to);
            expected += lamp.power.x / (4 * kPi) * to.z / (d * d * d);
        }
        double mean = 0;
        const int seeds = 64;
        for (std::uint32_t seed = 0; seed < seeds; ++seed) {
            const float e = stage.at(p, kUp, 0, 16, seed).x;
            // One estimate of 64 to 256 choices.
            EXPECT_NEAR(e, expected, 0.1 * expected) << "seed " << seed;
            mean += e / seeds;
        }
        EXPECT_NEAR(mean, expected, 0.01 * expected);  // unbiased
    }
}

TEST(DirectLight, one_strong_lamp_among_many_weak_ones_has_no_noise) {
    Scene scene;
    test::add_quad(scene, "far away", vec3(0, 0, -50), kX, kY, kNone);
    scene.lamps.push_back(point_lamp(vec3(0, 0, 2), 1000));
    for (int i = 0; i < 100; ++i) {
        scene.lamps.push_back(point_lamp(vec3(i, 5, 3), 0.01F));
    }
    const Stage stage(scene);
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        EXPECT_NEAR(stage.at(vec3(0), kUp, 0, 16, seed).x, 250, 0.25) << seed;
    }
}

TEST(DirectLight, is_deterministic) {
    Scene scene;
    test::add_quad(scene, "blocker", vec3(-9, -5, 1), 9.0F * kX, 10.0F * kY, kNone);
    scene.lamps.push_back(point_lamp(vec3(0, 0, 2), 1, 0.3F));
    const Stage stage(scene);
    EXPECT_EQ(stage.at(vec3(0), kUp, 0.1F, 16, 5), stage.at(vec3(0), kUp, 0.1F, 16, 5));
    EXPECT_NE(stage.at(vec3(0), kUp, 0.1F, 16, 5), stage.at(vec3(0), kUp, 0.1F, 16, 6));
}

TEST(DirectLight, below_the_geometric_horizon_there_is_no_light) {
    Scene scene;
    test::add_quad(scene, "far away", vec3(0, 0, -50), kX, kY, kNone);
    scene.lamps.push_back(point_lamp(vec3(1, 0, -0.1F), 1));
    const Stage stage(scene);
    const vec3 leaning = glm::normalize(vec3(1, 0, 1));
    const SurfacePoint tilted{vec3(0), kUp, leaning};
    EXPECT_EQ(stage.light.irradiance({&tilted, 1}, {.samples = 16}, 1), vec3(0));
    const SurfacePoint flat{vec3(0), leaning, leaning};
    EXPECT_GT(stage.light.irradiance({&flat, 1}, {.samples = 16}, 1).x, 0.5F);
}

class LeafIrradiance : public testing::Test {
protected:
    std::vector<vec3> solve(const Scene& scene, const PatchTree& tree) {
        const RayScene rays(scene);
        Progress progress;
        const DirectLight light(scene, rays, DirectLightMode::kExplicit, progress);
        return light.leaf_irradiance(tree, progress);
    }
};

TEST_F(LeafIrradiance, parallel_squares) {
    // Form factor of parallel unit squares at distance d: E = pi F for radiance 1.
    const std::array<std::array<float, 2>, 4> known{
        {{0.25F, .632036430F}, {0.5F, .415253284F}, {1, .199824896F}, {4, .019106958F}}};
    for (const auto& [d, factor] : known) {
        Scene scene;
        const int white = test::add_material(scene, vec3(0.5F));
        const int emitter = test::add_material(scene, vec3(0), vec3(1));
        test::add_quad(scene, "floor", vec3(0), kX, kY, white);
        test::add_quad(scene, "emitter", vec3(0, 0, d), kX, kY, emitter);
        for (const float leaf : {2.0F, 0.3F}) {
            const PatchTree tree = test::front_tree(scene, leaf);
            const auto e = solve(scene, tree);
            const float mean = test::area_mean(tree, test::leaves_of(tree, 0), e).x;
            EXPECT_NEAR(mean, kPi * factor, 0.01F * kPi * factor) << d << " leaf " << leaf;
        }
    }
}

TEST_F(LeafIrradiance, half_shadowed_leaf_gets_half) {
    Scene scene;
    const int white = test::add_material(scene, vec3(0.5F));
    test::add_quad(scene, "floor", vec3(-0.5F, -0.5F, 0), kX, kY, white);
    test::add_quad(scene, "blocker", vec3(-9, -9, 10), 9.0F * kX, 18.0F * kY, white);
    Lamp sun;
    sun.type = LampType::kSun;
    sun.power = vec3(2);
    scene.lamps.push_back(sun);
    const PatchTree tree = test::front_tree(scene, 20);
    const auto e = solve(scene, tree);
    const auto floor = test::leaves_of(tree, 0);
    ASSERT_EQ(floor.size(), 1U);
    EXPECT_NEAR(e[static_cast<std::size_t>(floor[0])].x, 1, 0.02F);
}

TEST_F(LeafIrradiance, averages_over_the_exposed_part_only) {
    Scene scene;
    const int white = test::add_material(scene, vec3(0.5F));
    test::add_quad(scene, "floor", vec3(-0.5F, -0.5F, 0), kX, kY, white);
    test::add_quad(scene, "blocker", vec3(-9, -9, 10), 9.0F * kX, 18.0F * kY, white);
    Lamp sun;
    sun.type = LampType::kSun;
    sun.power = vec3(2);
    scene.lamps.push_back(sun);
    PatchTree tree = test::front_tree(scene, 20);
    const auto leaf = static_cast<std::size_t>(test::leaves_of(tree, 0)[0]);
    // Strata with x > 0, found by their own points: those are lit.
    tree.exposed_mask.assign(tree.size(), 0xffff);
    std::uint16_t lit = 0;
    for (unsigned i = 0; i < 16; ++i) {
        const vec2 centre((static_cast<float>(i % 4) + 0.5F) / 4,
                          (static_cast<float>(i / 4) + 0.5F) / 4);
        if (tree.patch_point(static_cast<NodeId>(leaf), centre).x > 0)
            lit = static_cast<std::uint16_t>(lit | 1U << i);
    }
    EXPECT_EQ(std::popcount(lit), 8);
    tree.exposed_mask[leaf] = lit;
    EXPECT_NEAR(solve(scene, tree)[leaf].x, 2, 1e-4F);
    tree.exposed_mask[leaf] = static_cast<std::uint16_t>(~lit);
    EXPECT_EQ(solve(scene, tree)[leaf].x, 0);
    tree.exposed_mask[leaf] = 0;
    EXPECT_EQ(solve(scene, tree)[leaf].x, 0);
}

TEST_F(LeafIrradiance, inner_nodes_stay_zero_and_cancel_works) {
    Scene scene;
    const int white = test::add_material(scene, vec3(0.5F));
    test::add_quad(scene, "floor", vec3(-0.5F, -0.5F, 0), kX, kY, white);
    scene.lamps.push_back(point_lamp(vec3(0, 0, 1), 1));
    const PatchTree tree = test::front_tree(scene, 0.1F);
    const auto e = solve(scene, tree);
    ASSERT_GT(tree.size(), tree.leaves.size());
    for (std::size_t n = 0; n < tree.size(); ++n) {
        EXPECT_EQ(e[n].x > 0, tree.is_leaf(static_cast<NodeId>(n)));
    }
    const RayScene rays(scene);
    Progress progress;
    const DirectLight light(scene, rays, DirectLightMode::kExplicit, progress);
    Progress cancelled(nullptr, [] { return true; });
    cancelled.cancel();
    EXPECT_THROW(std::ignore = light.leaf_irradiance(tree, cancelled), Cancelled);
}

TEST_F(LeafIrradiance, shares_of_lights_add_up) {
    // Two lamps, each with rays of its own; and 50 panels of two materials, of which some are
    // chosen.
    Scene scene;
    const int white = test::add_material(scene, vec3(0.5F));
    const int red = test::add_material(scene, vec3(0), vec3(4, 0, 0));
    const int blue = test::add_material(scene, vec3(0), vec3(0, 0, 4));
    test::add_quad(scene, "floor", vec3(0), 5.0F * kX, 5.0F * kY, white);
    for (int i = 0; i < 50; ++i) {
        const vec3 corner(static_cast<float>(i % 10) * 0.5F, static_cast<float>(i / 10), 2);
        test::add_quad(scene, "panel", corner, 0.2F * kX, 0.2F * kY, i % 2 ? red : blue);
    }
    scene.lamps.push_back(point_lamp(vec3(1, 1, 1), 1));
    scene.lamps.push_back(point_lamp(vec3(4, 4, 1), 2));
    const PatchTree tree = test::front_tree(scene, 1);
    const RayScene rays(scene);
    Progress progress;
    const DirectLight light(scene, rays, DirectLightMode::kExplicit, progress);
    LightShares shares;
    const std::vector<vec3> all = light.leaf_irradiance(tree, progress, &shares);
    ASSERT_EQ(shares.lights, (std::vector<LightSource>{
                                 {.lamp = 0}, {.lamp = 1}, {.material = blue}, {.material = red}}));
    for (const NodeId leaf : tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        vec3 sum(0);
        for (const auto& share : shares.irradiance)
            sum += share[n];
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(sum[c], all[n][c], 1e-5F * all[n][c]);
        EXPECT_EQ(shares.irradiance[2][n].x, 0) << "blue panels send no red";
        EXPECT_EQ(shares.irradiance[3][n].z, 0);
    }
}

TEST(SpreadFirst, keeps_all_points_and_begins_with_the_diagonal) {
    std::vector<SurfacePoint> points;
    for (int i = 0; i < 16; ++i)
        points.push_back({vec3(i, 0, 0), kUp, kUp});
    const std::vector<SurfacePoint> ordered = spread_first(points, 4);
    std::vector<float> places;
    for (const SurfacePoint& p : ordered)
        places.push_back(p.position.x);
    EXPECT_EQ(std::vector<float>(places.begin(), places.begin() + 4),
              (std::vector<float>{0, 5, 10, 15}));
    std::sort(places.begin(), places.end());
    for (std::size_t i = 0; i < 16; ++i)
        EXPECT_EQ(places[i], static_cast<float>(i));
}

// Rays end earlier where other light hides their noise, which changes nothing on the average.
TEST(DirectLight, noise_that_indirect_light_hides_is_left) {
    Scene scene;
    const int white = test::add_material(scene, vec3(0.5F));
    test::add_quad(scene, "blind", vec3(-1, 0, 1), vec3(2, 0, 0), vec3(0, 1, 0), white);
    const int bright = test::add_material(scene, vec3(0), vec3(1));
    test::add_quad(scene, "lamp", vec3(-0.5F, -0.5F, 2), kY, kX, bright);
    const Stage stage(scene);
    const SurfacePoint point{vec3(0), kUp, kUp};
    double strict = 0;
    double lax = 0;
    double strict_error = 0;
    double lax_error = 0;
    constexpr int kRuns = 400;
    const float truth = stage.light.irradiance({&point, 1}, {.samples = 4096}, 1).x;
    for (std::uint32_t seed = 0; seed < kRuns; ++seed) {
        const float a = stage.light.irradiance({&point, 1}, {}, seed).x;
        const float b = stage.light.irradiance({&point, 1}, {.indirect = 100 * truth}, seed).x;
        strict += a / kRuns;
        lax += b / kRuns;
        strict_error += (a - truth) * (a - truth) / kRuns;
        lax_error += (b - truth) * (b - truth) / kRuns;
    }
    // 400 runs: the error of their mean is a twentieth of a run's.
    EXPECT_NEAR(strict, truth, 4 * std::sqrt(strict_error) / 20 + 0.002 * truth);
    EXPECT_NEAR(lax, truth, 4 * std::sqrt(lax_error) / 20 + 0.002 * truth);
    EXPECT_LT(std::sqrt(strict_error), 0.02 * truth);
    EXPECT_GT(lax_error, 2 * strict_error);
}

}  // namespace
}  // namespace antiradiance
