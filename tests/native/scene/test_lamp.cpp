// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/lamp.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

namespace antiradiance {
namespace {

vec3 tilted(float angle) {  // from straight down towards +x
    return {std::sin(angle), 0, -std::cos(angle)};
}

TEST(Lamp, a_point_lamp_spreads_its_power_over_the_sphere) {
    Lamp lamp;
    lamp.power = vec3(100, 10, 0);
    EXPECT_NEAR(lamp_intensity(lamp).x, 100 / 12.566371F, 1e-4F);
    EXPECT_NEAR(lamp_intensity(lamp).y, 10 / 12.566371F, 1e-5F);
}

TEST(Lamp, spot_cone_is_sharp_without_blend) {
    Lamp lamp{.name = "spot", .type = LampType::kSpot, .spot_angle = 1.0F};
    EXPECT_EQ(spot_falloff(lamp, tilted(0)), 1);
    EXPECT_EQ(spot_falloff(lamp, tilted(0.499F)), 1);
    EXPECT_EQ(spot_falloff(lamp, tilted(0.501F)), 0);
    EXPECT_EQ(spot_falloff(lamp, vec3(0, 0, 1)), 0);
    lamp.spot_cosine = true;
    EXPECT_NEAR(spot_falloff(lamp, tilted(0.4F)), std::cos(0.4F), 1e-6F);
}

TEST(Lamp, spot_blend_fades_by_smoothstep_in_the_cosine) {
    Lamp lamp{.name = "spot", .type = LampType::kSpot, .spot_angle = 2.0F, .spot_blend = 0.5F};
    const float edge = std::cos(1.0F);
    const float fade = 0.5F * (1 - edge);
    EXPECT_NEAR(spot_falloff(lamp, tilted(std::acos(edge + 0.5F * fade))), 0.5F, 1e-5F);
    EXPECT_NEAR(spot_falloff(lamp, tilted(std::acos(edge + 0.25F * fade))), 0.15625F, 1e-5F);
    EXPECT_NEAR(spot_falloff(lamp, tilted(std::acos(edge + 1.01F * fade))), 1, 1e-5F);
}

TEST(Lamp, a_scaled_spot_has_an_elliptic_cone) {
    Lamp lamp{.name = "spot", .type = LampType::kSpot};
    lamp.to_world = glm::scale(mat4(1), vec3(2, 1, 1));
    lamp.spot_angle = 1.0F;
    const float along_x = std::atan(2 * std::tan(0.5F));
    EXPECT_EQ(spot_falloff(lamp, tilted(along_x - 0.01F)), 1);
    EXPECT_EQ(spot_falloff(lamp, tilted(along_x + 0.01F)), 0);
    lamp.spot_cosine = true;  // Blender 3.4 ignores the scale
    EXPECT_EQ(spot_falloff(lamp, tilted(0.51F)), 0);
}

TEST(Lamp, area_lamp_in_world_space) {
    Lamp lamp{.name = "area", .type = LampType::kArea, .power = vec3(80)};
    lamp.to_world = glm::scale(glm::translate(mat4(1), vec3(0, 0, 3)), vec3(2, 0.5F, 7));
    lamp.size = vec2(1, 4);
    EXPECT_NEAR(area_lamp_radiance(lamp).x, 80.0F / (4 * 4), 1e-5F);  // 2 m x 2 m
    lamp.shape = AreaShape::kEllipse;
    EXPECT_NEAR(area_lamp_radiance(lamp).x, 80.0F / (4 * kPi), 1e-5F);
}

TEST(Lamp, area_corners_turn_left_seen_from_the_lit_side) {
    for (const float mirror : {1.0F, -1.0F}) {
        Lamp lamp{.name = "area", .type = LampType::kArea};
        lamp.to_world = glm::scale(mat4(1), vec3(mirror, 1, 1));
        const auto c = area_lamp_corners(lamp);
        const vec3 n = glm::cross(c[1] - c[0], c[2] - c[0]);
        EXPECT_LT(n.z, 0) << "mirror " << mirror;
        EXPECT_LT(lamp_direction(lamp).z, 0);
    }
}

TEST(Lamp, spread_keeps_the_power) {
    // Flux of a diffuse emitter is pi x radiance; integrate the factor over the hemisphere.
    for (const float spread : {0.3F, 1.2F, 2.5F}) {
        Lamp lamp{.name = "area", .type = LampType::kArea, .spread = spread};
        const int n = 20000;
        double flux = 0;
        for (int i = 0; i < n; ++i) {
            const double angle = (i + 0.5) / n * kPi / 2;
            const double cosine = std::cos(angle);
            flux += area_lamp_spread(lamp, tilted(static_cast<float>(angle))) * 2 * kPi * cosine *
                    std::sin(angle) * (kPi / 2 / n);
        }
        EXPECT_NEAR(flux, kPi, 1e-3 * kPi) << spread;
    }
    EXPECT_EQ(area_lamp_spread(Lamp{}, tilted(1.5F)), 1);
}

}  // namespace
}  // namespace antiradiance
