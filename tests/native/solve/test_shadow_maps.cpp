// SPDX-License-Identifier: GPL-3.0-or-later
// Direct light by shadow maps against closed forms and against shadow rays.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "base/error.h"
#include "base/random.h"
#include "gpu/gl_test.h"
#include "solve/direct_light.h"
#include "support/scene_builder.h"
#include "support/tree_builder.h"

namespace antiradiance {
namespace {

const vec3 kUp(0, 0, 1);
const vec3 kX(1, 0, 0);
const vec3 kY(0, 1, 0);

// The same scene by maps and by rays.
struct Stage {
    explicit Stage(const Scene& s)
        : scene(s),
          rays(scene),
          maps(scene, rays, DirectLightMode::kShadowMaps, progress),
          traced(scene, rays, DirectLightMode::kExplicit, progress) {}

    [[nodiscard]] std::vector<vec3> by_maps(const std::vector<SurfacePoint>& points) {
        std::vector<std::uint32_t> ends;
        for (std::uint32_t i = 0; i < points.size(); ++i)
            ends.push_back(i + 1);
        return maps.mapped_irradiance(points, ends, progress, {});
    }
    [[nodiscard]] float at(const vec3& p, const vec3& n = kUp) { return by_maps({{p, n, n}})[0].x; }
    [[nodiscard]] vec3 by_rays(const SurfacePoint& point) const {
        return traced.irradiance({&point, 1}, {.samples = 1024}, 1);
    }

    Progress progress;
    Scene scene;
    RayScene rays;
    DirectLight maps;
    DirectLight traced;
};

Lamp point_lamp(const vec3& position, float radius = 0) {
    Lamp lamp = test::lamp_at(LampType::kPoint, position, 4 * kPi);  // 1 W/sr
    lamp.radius = radius;
    return lamp;
}

class ShadowMapLight : public gpu::GlTest {};

// Points of the floor of a room of 4 m, also right beside its walls.
std::vector<SurfacePoint> floor_points(std::uint32_t count) {
    std::vector<SurfacePoint> points;
    for (std::uint32_t i = 0; i < count; ++i) {
        const vec2 at = 4.0F * r2_sample(i, 5);
        points.push_back({vec3(at, 0), kUp, kUp});
    }
    return points;
}

TEST_F(ShadowMapLight, a_hard_shadow_ends_where_it_should) {
    Scene scene;
    test::add_quad(scene, "floor", vec3(-3, -3, 0), 6.0F * kX, 6.0F * kY, kNone);
    // Over x < 0.1 at half height: the shadow's edge lies at x = 0.2.
    test::add_quad(scene, "blocker", vec3(-1, -1, 1), 1.1F * kX, 2.0F * kY, kNone);
    scene.lamps.push_back(point_lamp(vec3(0, 0, 2)));
    Stage stage(scene);
    // A face of the cube, of 2048 texels, is 4 m wide on the floor.
    const float texel = 4.0F / 2048;
    for (const float y : {-0.7F, 0.0F, 0.3F}) {
        const auto lit = [&](float x) { return stage.at({x, y, 0}); };
        const auto expected = [&](float x) {
            return static_cast<float>(2 / std::pow(4.0 + double{x} * x + double{y} * y, 1.5));
        };
        EXPECT_EQ(lit(0.2F - texel), 0);
        EXPECT_NEAR(lit(0.2F + texel), expected(0.2F + texel), 1e-5F);
        float edge = 0;  // where half of the light arrives
        for (float x = 0.19F; x < 0.21F; x += texel / 20) {
            if (lit(x) < 0.5F * expected(x)) edge = x;
        }
        EXPECT_NEAR(edge, 0.2F, texel) << y;
    }
}

TEST_F(ShadowMapLight, unshadowed_light_is_that_of_rays) {
    const vec3 above(0.3F, -0.2F, 2);
    std::vector<Lamp> lamps{point_lamp(above), point_lamp(above, 0.4F)};
    lamps.push_back(test::lamp_at(LampType::kSpot, above, 100));
    lamps.back().spot_angle = 1.5F;
    lamps.back().spot_blend = 0;
    lamps.push_back(test::lamp_at(LampType::kSun, above, 1));
    lamps.back().sun_angle = 0.2F;
    lamps.push_back(test::lamp_at(LampType::kArea, above, 1));
    lamps.push_back(test::lamp_at(LampType::kArea, above, 1));
    lamps.back().shape = AreaShape::kEllipse;
    for (const Lamp& lamp : lamps) {
        Scene scene;
        test::add_quad(scene, "floor", vec3(-1, -1, 0), 2.0F * kX, 2.0F * kY, kNone);
        scene.lamps.push_back(lamp);
        Stage stage(scene);
        std::vector<SurfacePoint> points;
        for (std::uint32_t i = 0; i < 50; ++i)
            points.push_back({vec3(2.0F * r2_sample(i, 1) - 1.0F, 0), kUp, kUp});
        const std::vector<vec3> found = stage.by_maps(points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const float expected = stage.by_rays(points[i]).x;
            EXPECT_NEAR(found[i].x, expected, 1e-4F * expected)
                << static_cast<int>(lamp.type) << " at " << points[i].position.x;
        }
    }
}

// No surface shadows itself, at any angle and right up to the edges; none is lit from behind.
TEST_F(ShadowMapLight, surfaces_do_not_shadow_themselves) {
    Scene scene;
    test::add_box(scene, "room", vec3(0), vec3(4, 4, 3), kNone, test::Facing::kInward);
    scene.lamps.push_back(point_lamp(vec3(1.1F, 2.3F, 2.99F)));  // light grazes the ceiling
    Stage stage(scene);
    const std::array<vec3, 6> corner{vec3(0),       vec3(0, 0, 3), vec3(0),
                                     vec3(4, 0, 0), vec3(0),       vec3(0, 4, 0)};
    const std::array<std::array<vec3, 2>, 6> edges{{{4.0F * kX, 4.0F * kY},
                                                    {4.0F * kX, 4.0F * kY},
                                                    {4.0F * kY, 3.0F * kUp},
                                                    {4.0F * kY, 3.0F * kUp},
                                                    {4.0F * kX, 3.0F * kUp},
                                                    {4.0F * kX, 3.0F * kUp}}};
    const std::array<vec3, 6> normal{kUp, -kUp, kX, -kX, kY, -kY};
    std::size_t dark = 0;
    std::size_t all = 0;
    for (std::size_t side = 0; side < 6; ++side) {
        std::vector<SurfacePoint> points;
        for (std::uint32_t i = 0; i < 4000; ++i) {
            const vec2 u = 0.0005F + 0.999F * r2_sample(i, 3);
            points.push_back({corner[side] + u.x * edges[side][0] + u.y * edges[side][1],
                              normal[side], normal[side]});
        }
        const std::vector<vec3> found = stage.by_maps(points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const vec3 to = vec3(1.1F, 2.3F, 2.99F) - points[i].position;
            const float d = glm::length(to);
            const float expected = glm::dot(to, normal[side]) / (d * d * d);
            dark += found[i].x < 0.99F * expected ? 1 : 0;
            EXPECT_LE(found[i].x, 1.0001F * expected);
            ++all;
        }
    }
    // Within a texel of a corner, the wall beside a point can stand for its blocker.
    std::cout << dark << " of " << all << " points in a false shadow\n";
    EXPECT_LT(dark, all / 500);
}

// Two rooms with a wall of 1 cm between them, and with one of no thickness at all: nothing gets
// through. Only at the foot of a wall thinner than a texel, that texel still shows the lit side.
TEST_F(ShadowMapLight, walls_are_tight) {
    for (const float thickness : {0.01F, 0.0F}) {
        Scene scene;
        test::add_box(scene, "lit", vec3(-4, 0, 0), vec3(0, 4, 3), kNone, test::Facing::kInward);
        if (thickness > 0) {
            test::add_box(scene, "dark", vec3(thickness, 0, 0), vec3(4, 4, 3), kNone,
                          test::Facing::kInward);
        } else {
            test::add_quad(scene, "floor", vec3(0), 4.0F * kX, 4.0F * kY, kNone);
        }
        scene.lamps.push_back(point_lamp(vec3(-1, 2, 1.5F)));
        scene.lamps.push_back(test::lamp_at(LampType::kArea, vec3(-2, 2, 2.9F), 10));
        Stage stage(scene);
        // 129 points of lamps share the memory: 227 texels along a face, which is 5.8 m wide where
        // the area lamp's meets the floor.
        constexpr float kTexel = 5.8F / 227;
        std::vector<SurfacePoint> floor;
        std::vector<SurfacePoint> wall;
        for (std::uint32_t i = 0; i < 20'000; ++i) {
            const vec2 u = r2_sample(i, 7);
            const float x = thickness + (i % 3 == 0 ? 0.1F : 4.0F) * (0.001F + 0.998F * u.x);
            floor.push_back({vec3(x, 0.01F + 3.98F * u.y, 0), kUp, kUp});
            wall.push_back({vec3(thickness, 4 * u.x, 3 * u.y), kX, kX});
        }
        for (const vec3& e : stage.by_maps(wall))
            ASSERT_EQ(e.x, 0) << "the dark side of the wall";
        const std::vector<vec3> light = stage.by_maps(floor);
        float farthest = 0;
        for (std::size_t i = 0; i < floor.size(); ++i) {
            if (light[i].x > 0) farthest = std::max(farthest, floor[i].position.x);
        }
        std::cout << "wall of " << thickness << " m: light up to " << farthest << " m\n";
        EXPECT_LT(farthest, 1.5F * kTexel);  // the texel, seen aslant
        EXPECT_GT(stage.at(vec3(-0.001F, 2, 0)), 0.05F) << "the lit side of the wall's foot";
        EXPECT_GT(stage.at(vec3(0, 2, 1), -kX), 0.5F) << "the lit side of the wall";
    }
}

TEST_F(ShadowMapLight, half_a_lamp_gives_half_of_its_light) {
    Scene stage;
    test::add_quad(stage, "blocker", vec3(-9, -9, 1), 9.0F * kX, 18.0F * kY, kNone);
    const auto ratio = [&](const Lamp& lamp) {
        Scene open;
        test::add_quad(open, "far away", vec3(-1, -1, -50), 2.0F * kX, 2.0F * kY, kNone);
        open.lamps.push_back(lamp);
        Scene half = stage;
        half.lamps.push_back(lamp);
        return Stage(half).at(vec3(0)) / Stage(open).at(vec3(0));
    };
    Lamp sun = test::lamp_at(LampType::kSun, vec3(0), 1);
    sun.sun_angle = 0.1F;
    Lamp disk = test::lamp_at(LampType::kArea, vec3(0, 0, 2), 1);
    disk.shape = AreaShape::kEllipse;
    // Each point is either seen or not: half of 128, or of a sun's 16, up to their even spread.
    EXPECT_NEAR(ratio(point_lamp(vec3(0, 0, 2), 0.3F)), 0.5F, 0.05F);
    EXPECT_NEAR(ratio(test::lamp_at(LampType::kArea, vec3(0, 0, 2), 1)), 0.5F, 0.05F);
    EXPECT_NEAR(ratio(disk), 0.5F, 0.05F);
    EXPECT_NEAR(ratio(sun), 0.5F, 0.1F);
}

// A ball of some 900 triangles: more emitters than maps, of which each sees less than half.
TEST_F(ShadowMapLight, few_points_stand_for_many_emitters) {
    Scene scene;
    const int glow = test::add_material(scene, vec3(0), vec3(3));
    test::add_quad(scene, "floor", vec3(-3, -3, 0), 6.0F * kX, 6.0F * kY, kNone);
    test::add_ball(scene, "ball", vec3(0, 0, 1.5F), 0.3F, 16, glow);
    Stage stage(scene);
    EXPECT_LE(stage.maps.maps().images, 256U * 5);
    double sum = 0;
    constexpr int kPoints = 40;
    for (std::uint32_t i = 0; i < kPoints; ++i) {
        const vec3 p(4.0F * r2_sample(i, 1) - 2.0F, 0);
        const float d = glm::distance(p, vec3(0, 0, 1.5F));
        // A ball of radiance L and radius r: pi L r^2 cos / d^2;
        const float expected = kPi * 3 * 0.09F * 1.5F / (d * d * d);
        const float found = stage.at(p);
        EXPECT_NEAR(found / expected, 1, 0.12F) << i;
        sum += found / expected / kPoints;
    }
    std::cout << "mean " << sum << " of the ball's light\n";
    // The facets are 1.2 % smaller than the ball; 256 of 960 triangles stand for all.
    EXPECT_NEAR(sum, 1, 0.02);
}

// Above the lamp there is only luminous black, as inside a luminous ball; below it, the floor.
TEST_F(ShadowMapLight, a_lamp_below_a_luminous_ceiling_still_shines) {
    Scene scene;
    test::add_quad(scene, "floor", vec3(-3, -3, 0), 6.0F * kX, 6.0F * kY,
                   test::add_material(scene, vec3(0.5F)));
    const int faint = test::add_material(scene, vec3(0), vec3(1e-6F));
    test::add_quad(scene, "ceiling", vec3(-50, -50, 1.001F), 100.0F * kX, 100.0F * kY, faint);
    scene.lamps.push_back(point_lamp(vec3(0, 0, 1)));
    EXPECT_NEAR(Stage(scene).at(vec3(0)), 1, 1e-4F);
}

TEST_F(ShadowMapLight, lights_leaves_like_rays) {
    Scene scene;
    const int white = test::add_material(scene, vec3(0.5F));
    test::add_box(scene, "room", vec3(0), vec3(4, 4, 3), white, test::Facing::kInward);
    test::add_box(scene, "block", vec3(1.2F, 1, 0.01F), vec3(2, 2, 1), white);
    scene.lamps.push_back(test::lamp_at(LampType::kArea, vec3(2, 2, 2.9F), 10));
    Stage stage(scene);
    const PatchTree tree = test::front_tree(scene, 0.3F);
    const auto maps = stage.maps.leaf_irradiance(tree, stage.progress);
    const auto rays = stage.traced.leaf_irradiance(tree, stage.progress);
    double error2 = 0;
    double light = 0;
    double area = 0;
    for (const NodeId leaf : tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        const double difference = maps[n].x - rays[n].x;
        error2 += tree.area[n] * difference * difference;
        light += double{tree.area[n]} * rays[n].x;
        area += tree.area[n];
    }
    const double rms = std::sqrt(error2 / area) / (light / area);
    std::cout << "relative RMS over the leaves " << rms << "\n";
    EXPECT_LT(rms, 0.05);
}

TEST_F(ShadowMapLight, can_be_cancelled) {
    Scene scene;
    test::add_quad(scene, "floor", vec3(-3, -3, 0), 6.0F * kX, 6.0F * kY, kNone);
    scene.lamps.push_back(test::lamp_at(LampType::kArea, vec3(0, 0, 2), 10));
    const RayScene rays(scene);
    Progress stopped(nullptr, [] { return true; });
    EXPECT_THROW(DirectLight(scene, rays, DirectLightMode::kShadowMaps, stopped), Cancelled);
    Stage stage(scene);
    const std::vector<SurfacePoint> points = floor_points(1000);
    const std::vector<std::uint32_t> ends{1000};
    Progress later(nullptr, [] { return true; });
    EXPECT_THROW(std::ignore = stage.maps.mapped_irradiance(points, ends, later, {}), Cancelled);
}

}  // namespace
}  // namespace antiradiance
