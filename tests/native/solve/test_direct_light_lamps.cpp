// SPDX-License-Identifier: GPL-3.0-or-later
// Lamps against closed forms and against Cycles of Blender 3.4.1.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "solve/direct_light.h"
#include "support/scene_builder.h"

namespace antiradiance {
namespace {

// A floor far below, so that nothing is in the way of receivers around z = 0.
Scene empty_stage(const Lamp& lamp) {
    Scene scene;
    test::add_quad(scene, "far away", vec3(-1, -1, -100), vec3(2, 0, 0), vec3(0, 2, 0), kNone);
    scene.lamps.push_back(lamp);
    return scene;
}

vec3 irradiance_at(const Scene& scene, const vec3& p, const vec3& n, int samples = 64) {
    const RayScene ray_scene(scene);
    Progress progress;
    const DirectLight light(scene, ray_scene, DirectLightMode::kExplicit, progress);
    const SurfacePoint point{p, n, n};
    return light.irradiance({&point, 1}, {.samples = samples}, 7);
}

const vec3 kUp(0, 0, 1);

TEST(DirectLightLamps, point_lamp_follows_the_inverse_square) {
    const Scene scene =
        empty_stage(test::lamp_at(LampType::kPoint, vec3(0, 0, 2), 4 * kPi));  // 1 W/sr
    EXPECT_NEAR(irradiance_at(scene, vec3(0), kUp).x, 1.0F / 4, 1e-6F);
    EXPECT_NEAR(irradiance_at(scene, vec3(0, 0, 1), kUp).x, 1, 1e-6F);
    // E = I cos / d^2 with d^2 = 8, cos = 1 / sqrt 2
    EXPECT_NEAR(irradiance_at(scene, vec3(2, 0, 0), kUp).x, 1 / (8 * std::sqrt(2.0F)), 1e-6F);
    EXPECT_EQ(irradiance_at(scene, vec3(0), -kUp), vec3(0));
}

TEST(DirectLightLamps, colour_is_kept) {
    Lamp lamp = test::lamp_at(LampType::kPoint, vec3(0, 0, 1), 0);
    lamp.power = 4 * kPi * vec3(1, 0.5F, 0);
    const vec3 e = irradiance_at(empty_stage(lamp), vec3(0), kUp);
    EXPECT_NEAR(e.x, 1, 1e-6F);
    EXPECT_NEAR(e.y, 0.5F, 1e-6F);
    EXPECT_EQ(e.z, 0);
}

TEST(DirectLightLamps, a_sphere_above_the_horizon_lights_like_its_centre) {
    Lamp lamp = test::lamp_at(LampType::kPoint, vec3(1, 0, 1), 4 * kPi);
    lamp.radius = 0.5F;
    EXPECT_NEAR(irradiance_at(empty_stage(lamp), vec3(0), kUp).x, 0.5F / std::sqrt(2.0F), 1e-5F);
}

TEST(DirectLightLamps, a_sphere_half_below_the_horizon) {
    // Radiance I / (pi r^2) from half a disk of directions with sin sigma = r / d:
    // integral of cos = asin(r/d) - r/d sqrt(1 - (r/d)^2).
    Lamp lamp = test::lamp_at(LampType::kPoint, vec3(2, 0, 0), 4 * kPi);
    lamp.radius = 1;
    const float s = 0.5F;
    const float expected = (std::asin(s) - s * std::sqrt(1 - s * s)) / kPi;
    EXPECT_NEAR(irradiance_at(empty_stage(lamp), vec3(0), kUp).x, expected, 1e-5F);
}

TEST(DirectLightLamps, sun) {
    Lamp lamp = test::lamp_at(LampType::kSun, vec3(0), 3);
    lamp.to_world = glm::rotate(mat4(1), kPi / 3, vec3(1, 0, 0));
    for (const float angle : {0.0F, 0.1F, 0.9F}) {  // a disk above the horizon changes nothing
        lamp.sun_angle = angle;
        EXPECT_NEAR(irradiance_at(empty_stage(lamp), vec3(0), kUp).x, 1.5F, 1e-5F) << angle;
    }
    EXPECT_EQ(irradiance_at(empty_stage(lamp), vec3(0), -kUp), vec3(0));
}

TEST(DirectLightLamps, area_lamp_lights_like_a_polygon) {
    // 1 m x 1 m, 2 m above a point below its corner, radiance power / (4 area).
    Lamp lamp = test::lamp_at(LampType::kArea, vec3(0.5F, 0.5F, 2), 40);
    const double x = 0.5;
    const double r = std::sqrt(1 + x * x);
    const double factor = 2 * x / r * std::atan(x / r) / (2 * kPi);
    const double expected = 10 * kPi * factor;
    EXPECT_NEAR(irradiance_at(empty_stage(lamp), vec3(0), kUp).x, expected, 1e-5 * expected);
    // It shines down only.
    EXPECT_EQ(irradiance_at(empty_stage(lamp), vec3(0, 0, 4), -kUp), vec3(0));
}

TEST(DirectLightLamps, round_area_lamp_lights_like_a_disk) {
    // Point on the axis of a disk: F = r^2 / (r^2 + h^2).
    for (const float h : {0.2F, 1.0F, 5.0F}) {
        Lamp lamp = test::lamp_at(LampType::kArea, vec3(0, 0, h), 1);
        lamp.shape = AreaShape::kEllipse;
        lamp.size = vec2(2, 2);
        const float radiance = 1 / (4 * kPi);
        const float expected = kPi * radiance / (1 + h * h);
        // The polygon that stands for the disk has 56 corners near, 12 far.
        EXPECT_NEAR(irradiance_at(empty_stage(lamp), vec3(0), kUp).x, expected, 1e-3F * expected)
            << h;
    }
}

// Mean irradiance in Cycles 3.4.1 over the floor z = 0, |x|, |y| < 4 (64 x 64 pixels, 1024 samples,
// no bounces, light threshold 0), and over 3 x 3 pixels around pixels (32,32), (20,40), (44,28).
struct CyclesCase {
    const char* name;
    Lamp lamp;
    float mean;
    std::array<float, 3> at;
};

Lamp tilted(LampType type, float angle, const vec3& position, float power,
            const vec3& scale = vec3(1)) {
    Lamp lamp = test::lamp_at(type, position, power);
    lamp.to_world = glm::rotate(lamp.to_world, angle, vec3(1, 0, 0));
    lamp.to_world = glm::scale(lamp.to_world, scale);
    lamp.spot_cosine = true;
    return lamp;
}

std::vector<CyclesCase> cycles_cases() {
    const vec3 above(0, 0, 3);
    const auto spot = [&](float tilt, const vec3& p, float size, float blend, float radius,
                          const vec3& scale = vec3(1)) {
        Lamp l = tilted(LampType::kSpot, tilt, p, 100, scale);
        l.spot_angle = size;
        l.spot_blend = blend;
        l.radius = radius;
        return l;
    };
    const auto point = [&](const vec3& p, float radius) {
        Lamp l = tilted(LampType::kPoint, 0, p, 100);
        l.radius = radius;
        return l;
    };
    const auto sun = [&](float angle) {
        Lamp l = tilted(LampType::kSun, 0.7F, above, 3);
        l.sun_angle = angle;
        return l;
    };
    const auto area = [&](const vec3& p, const vec2& size, AreaShape shape, float spread = kPi,
                          const vec3& scale = vec3(1)) {
        Lamp l = tilted(LampType::kArea, 0.3F, p, 100, scale);
        l.size = size;
        l.shape = shape;
        l.spread = spread;
        return l;
    };
    const auto rectangle = AreaShape::kRectangle;
    const auto ellipse = AreaShape::kEllipse;
    const vec3 low(0, 0, 1.2F);
    return {
        {"point", point(above, 0), 0.345415F, {0.87962F, 0.55999F, 0.60091F}},
        {"soft point", point({0.5F, 0.2F, 2}, 0.1F), 0.458122F, {1.82458F, 0.64256F, 1.21749F}},
        {"spot", spot(0.4F, {0.2F, 0.1F, 3}, 1, 0, 0), 0.089787F, {0.80233F, 0.30749F, 0}},
        {"spot blend", spot(0.4F, above, 1.2F, 0.5F, 0), 0.095145F, {0.81428F, 0.49004F, 0}},
        {"soft spot", spot(0.4F, above, 1.2F, 0.3F, 0.1F), 0.106399F, {0.81475F, 0.50875F, 0}},
        {"scaled spot",
         spot(0.4F, above, 1.2F, 0.3F, 0, {1, 2, 0.7F}),
         0.106524F,
         {0.81588F, 0.50927F, 0}},
        {"wide spot", spot(0.2F, above, kPi, 1, 0), 0.225426F, {0.86333F, 0.49163F, 0.46680F}},
        {"sun", sun(0), 2.294513F, {2.29451F, 2.29451F, 2.29451F}},
        {"soft sun", sun(0.1F), 2.293091F, {2.29310F, 2.29309F, 2.29309F}},
        {"square area", area(above, vec2(1), rectangle), 0.803059F, {2.57160F, 1.58064F, 1.51180F}},
        {"area", area(above, {1, 2}, rectangle), 0.799368F, {2.47467F, 1.52217F, 1.48524F}},
        {"near area", area(low, {1, 2}, rectangle), 1.087044F, {11.02507F, 2.11072F, 1.89692F}},
        {"disk", area(above, vec2(1), ellipse), 0.803734F, {2.59115F, 1.58592F, 1.51249F}},
        {"near ellipse", area(low, {1, 2}, ellipse), 1.088373F, {11.97514F, 2.10146F, 1.89104F}},
        {"scaled area",
         area(above, {1, 2}, rectangle, kPi, {2, 0.5F, 3}),
         0.798591F,
         {2.44430F, 1.57594F, 1.52165F}},
        {"spread",
         area(above, {1, 2}, rectangle, 1.2F),
         1.223767F,
         {11.35666F, 3.78618F, 0.81293F}},
        {"narrow spread", area(above, {1, 2}, ellipse, 0.3F), 1.227466F, {30.63506F, 0, 0}},
    };
}

vec3 pixel_center(float i, float j) {
    return {(i + 0.5F) / 8 - 4, (j + 0.5F) / 8 - 4, 0};
}

// One estimate ends when its noise can't be seen; the mean of many shows the units to better.
float mean_over_seeds(const DirectLight& light, std::span<const SurfacePoint> points, int seeds) {
    float sum = 0;
    for (int seed = 0; seed < seeds; ++seed) {
        sum += light.irradiance(points, {.samples = 64}, static_cast<std::uint32_t>(seed)).x;
    }
    return sum / static_cast<float>(seeds);
}

TEST(DirectLightLamps, agree_with_cycles) {
    constexpr std::array<std::array<int, 2>, 3> kPixels{{{32, 32}, {20, 40}, {44, 28}}};
    for (const CyclesCase& c : cycles_cases()) {
        SCOPED_TRACE(c.name);
        const Scene scene = empty_stage(c.lamp);
        const RayScene rays(scene);
        Progress progress;
        const DirectLight light(scene, rays, DirectLightMode::kExplicit, progress);
        std::vector<SurfacePoint> all;
        for (int j = 0; j < 128; ++j) {
            for (int i = 0; i < 128; ++i) {
                const vec3 p = pixel_center(static_cast<float>(i) / 2 - 0.25F,
                                            static_cast<float>(j) / 2 - 0.25F);
                all.push_back({p, kUp, kUp});
            }
        }
        // The measured pictures' own noise and the quadrature over 4 points a pixel stay below
        // 0.5 %; Blender's unit conventions differ by factors of pi / 4 and the like.
        const float mean = mean_over_seeds(light, all, 4);
        EXPECT_NEAR(mean, c.mean, 5e-3F * c.mean);
        for (std::size_t k = 0; k < 3; ++k) {
            std::vector<SurfacePoint> block;
            for (int j = 0; j < 12; ++j) {
                for (int i = 0; i < 12; ++i) {
                    const vec3 p = pixel_center(
                        static_cast<float>(kPixels[k][0] - 1) + (static_cast<float>(i) - 1.5F) / 4,
                        static_cast<float>(kPixels[k][1] - 1) + (static_cast<float>(j) - 1.5F) / 4);
                    block.push_back({p, kUp, kUp});
                }
            }
            EXPECT_NEAR(mean_over_seeds(light, block, 32), c.at[k], 1e-2F * c.at[k] + 1e-5F)
                << "pixel " << k;
        }
    }
}

}  // namespace
}  // namespace antiradiance
