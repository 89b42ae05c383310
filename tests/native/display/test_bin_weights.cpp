// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "base/random.h"
#include "display/bin_weights.h"

namespace antiradiance {
namespace {

vec3 direction(std::uint32_t i) {
    const vec2 u = r2_sample(i, 7);
    const float z = 1 - 2 * u.x;
    const float r = std::sqrt(1 - z * z);
    return {r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z};
}

TEST(BinWeights, weights_add_up_and_take_the_nearest_bins) {
    const DirectionBins bins(128);
    const BinWeights weights(bins, 32);
    ASSERT_EQ(weights.texels().size(), 6U * 32 * 32);
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < 32 * 32; ++i) {
            const BinWeights::Texel& t =
                weights.texels()[static_cast<std::size_t>(face * 32 * 32 + i)];
            const vec3 d = cube_texel_direction(face, i % 32, i / 32, 32);
            int sum = 0;
            for (int k = 0; k < BinWeights::kNearest; ++k) {
                sum += t.weight[k];
                EXPECT_GE(t.weight[std::max(k - 1, 0)] + 1, t.weight[k]);  // of 255, rounded
            }
            EXPECT_EQ(sum, 255);
            float nearest = -2;
            for (int b = 0; b < bins.count(); ++b)
                nearest = std::max(nearest, glm::dot(bins.axis(b), d));
            EXPECT_FLOAT_EQ(glm::dot(bins.axis(t.bin[0]), d), nearest);
        }
    }
}

TEST(BinWeights, a_constant_stays_one_and_a_smooth_field_nearly) {
    const DirectionBins bins(128);
    const BinWeights weights(bins, 128);
    const std::vector<vec3> constant(128, vec3(1, 2, 3));
    std::vector<vec3> axis;
    for (int b = 0; b < bins.count(); ++b)
        axis.push_back(bins.axis(b));
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const vec3 d = direction(i);
        EXPECT_NEAR(glm::distance(weights.interpolate(constant, d), vec3(1, 2, 3)), 0, 1e-5F);
        // Bins are .31 rad wide; the interpolated axis strays less than half of that.
        EXPECT_LT(glm::distance(weights.interpolate(axis, d), d), 0.13F);
    }
}

TEST(BinWeights, bins_do_not_show) {
    // The worst field: neighbours of 0 and 1. Over a border of nearest bins it would jump by 1.
    const DirectionBins bins(128);
    const BinWeights weights(bins, 256);
    std::vector<vec3> field(128);
    for (std::size_t b = 0; b < field.size(); ++b)
        field[b] = vec3(hash_u32(static_cast<std::uint32_t>(b)) & 1U ? 1.0F : 0.0F);
    float largest = 0;
    constexpr float kStep = 2.0F / 256;
    for (std::uint32_t i = 0; i < 4000; ++i) {
        const vec3 d = direction(i);
        const vec3 beside = glm::normalize(d + kStep * Frame(d).t);
        largest = std::max(largest, std::abs(weights.interpolate(field, d).x -
                                             weights.interpolate(field, beside).x));
    }
    EXPECT_LT(largest, 0.12F);
    EXPECT_GT(largest, 0.01F);
}

}  // namespace
}  // namespace antiradiance
