// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/direct_light_geometry.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/random.h"
#include "scene/scene.h"

namespace antiradiance {
namespace {

// Unit square at height h with its corner above the origin: the receiver of the configuration
// factor F = 1/2pi (X/sqrt(1+X2) atan(Y/sqrt(1+X2)) + Y/sqrt(1+Y2) atan(X/sqrt(1+Y2))), X = Y =
// 1/h.
double corner_factor(double h) {
    const double x = 1 / h;
    const double r = std::sqrt(1 + x * x);
    return 2 * x / r * std::atan(x / r) / (2 * kPi);
}

TEST(polygon_irradiance, square_above_a_point) {
    for (const float h : {0.1F, 1.0F, 10.0F}) {
        const std::array<vec3, 4> square{vec3(0, 0, h), vec3(1, 0, h), vec3(1, 1, h),
                                         vec3(0, 1, h)};
        const double expected = kPi * corner_factor(h);
        EXPECT_NEAR(polygon_irradiance(square, vec3(0, 0, 1)), expected, 1e-5 * expected) << h;
    }
}

TEST(polygon_irradiance, is_cut_at_the_horizon) {
    // A square centred on the horizon gives what its upper half gives.
    const std::array<vec3, 4> whole{vec3(-1, 2, -1), vec3(1, 2, -1), vec3(1, 2, 1), vec3(-1, 2, 1)};
    const std::array<vec3, 4> upper{vec3(-1, 2, 0), vec3(1, 2, 0), vec3(1, 2, 1), vec3(-1, 2, 1)};
    const vec3 up(0, 0, 1);
    EXPECT_NEAR(polygon_irradiance(whole, up), polygon_irradiance(upper, up), 1e-6F);
    EXPECT_GT(polygon_irradiance(whole, up), 0.08F);
    EXPECT_EQ(polygon_irradiance(whole, vec3(0, -1, 0)), 0);
    // A polygon around the whole upper hemisphere.
    const std::array<vec3, 3> roof{vec3(-1e5F, -1e5F, 1), vec3(1e5F, -1e5F, 1), vec3(0, 2e5F, 1)};
    EXPECT_NEAR(polygon_irradiance(roof, up), kPi, 1e-3F);
}

TEST(sphere_irradiance, agrees_with_an_integral_over_the_cone) {
    const int n = 200000;
    for (const float sigma : {0.2F, 0.8F, 1.5F}) {
        for (const float theta : {0.0F, 0.9F, 1.4F, 1.7F, 2.6F}) {
            const vec3 axis(std::sin(theta), 0, std::cos(theta));
            const float one_minus_cos = 1 - std::cos(sigma);
            double sum = 0;
            for (std::uint32_t i = 0; i < n; ++i) {
                sum += std::max(0.0F, sample_cone(axis, one_minus_cos, r2_sample(i, 3)).z);
            }
            const double expected = sum / n * 2 * one_minus_cos;  // over pi
            // The integral's own error with 200,000 points is below 1e-4.
            EXPECT_NEAR(sphere_irradiance(std::cos(theta), std::sin(sigma)), expected, 2e-4)
                << "sigma " << sigma << " theta " << theta;
        }
    }
}

TEST(sample_cone, is_uniform_and_stays_inside) {
    const vec3 axis = glm::normalize(vec3(1, -2, 0.5F));
    const float sigma = 0.7F;
    vec3 sum(0);
    const int n = 4096;
    for (std::uint32_t i = 0; i < n; ++i) {
        const vec3 d = sample_cone(axis, 1 - std::cos(sigma), r2_sample(i, 1));
        EXPECT_NEAR(glm::length(d), 1, 1e-5F);
        EXPECT_GE(glm::dot(d, axis), std::cos(sigma) - 1e-5F);
        sum += d;
    }
    // The mean direction of a uniform cap has length (1 + cos sigma) / 2.
    EXPECT_NEAR(glm::dot(sum, axis) / n, (1 + std::cos(sigma)) / 2, 1e-3F);
    EXPECT_NEAR(glm::length(sum) / n, (1 + std::cos(sigma)) / 2, 1e-3F);
}

TEST(SphericalTriangle, octant) {
    const SphericalTriangle octant(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1));
    EXPECT_NEAR(octant.solid_angle(), kPi / 2, 1e-5F);
    // Uniform in the octant: each coordinate has mean 1/2, and z is uniform in [0, 1].
    vec3 sum(0);
    int below_quarter = 0;
    const int n = 4096;
    for (std::uint32_t i = 0; i < n; ++i) {
        const vec3 d = octant.sample(r2_sample(i, 5));
        ASSERT_GE(std::min({d.x, d.y, d.z}), -1e-5F);
        sum += d;
        below_quarter += d.z < 0.25F ? 1 : 0;
    }
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(sum[c] / n, 0.5F, 2e-3F);
    }
    EXPECT_NEAR(static_cast<float>(below_quarter) / n, 0.25F, 5e-3F);
}

}  // namespace
}  // namespace antiradiance
