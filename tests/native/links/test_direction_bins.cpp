// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/direction_bins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/random.h"

namespace antiradiance {
namespace {

vec3 random_direction(std::uint32_t i) {
    const vec2 u = r2_sample(i, 11);
    const float z = 2 * u.x - 1;
    const float r = std::sqrt(std::max(0.0F, 1 - z * z));
    return {r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z};
}

constexpr std::uint32_t kDirections = 200'000;

TEST(DirectionBins, EveryDirectionHasTheNearestAxis) {
    for (const int count : {32, 128, 512}) {
        const DirectionBins bins(count);
        std::uint32_t other = 0;
        float worst = 0;  // rad further than the nearest axis
        for (std::uint32_t i = 0; i < kDirections / 10; ++i) {
            const vec3 d = random_direction(i);
            float best = -1;
            for (int b = 0; b < count; ++b)
                best = std::max(best, glm::dot(d, bins.axis(b)));
            const float own = glm::dot(d, bins.axis(bins.bin(d)));
            if (own < best) {
                ++other;
                worst = std::max(worst,
                                 std::acos(std::min(1.0F, own)) - std::acos(std::min(1.0F, best)));
            }
        }
        // Only within a texel of a border: a texel of the cube map is .016 rad across its diagonal
        // at most .022, so an axis is never taken that is further by more than that.
        EXPECT_LT(worst, 0.022F) << count;
        // Borders are some 2 sqrt(pi / count) long a bin; the strip that texels blur is half one
        // wide on average.
        const float share = static_cast<float>(other) / (kDirections / 10.0F);
        EXPECT_LT(share, 0.01F * std::sqrt(static_cast<float>(count) / 32)) << count;
    }
}

TEST(DirectionBins, SolidAnglesAreNearlyEqual) {
    for (const int count : {32, 128, 512, 1024}) {
        const DirectionBins bins(count);
        std::vector<int> hits(static_cast<std::size_t>(count), 0);
        for (std::uint32_t i = 0; i < kDirections; ++i)
            ++hits[static_cast<std::size_t>(bins.bin(random_direction(i)))];
        const float mean = static_cast<float>(kDirections) / static_cast<float>(count);
        const auto [least, most] = std::minmax_element(hits.begin(), hits.end());
        std::cout << count << " bins: " << static_cast<float>(*least) / mean << " to "
                  << static_cast<float>(*most) / mean << " of the mean\n";
        // The Voronoi cells of a Fibonacci sphere; the two at its poles differ most.
        EXPECT_GT(static_cast<float>(*least), 0.8F * mean) << count;
        EXPECT_LT(static_cast<float>(*most), 1.2F * mean) << count;
    }
}

TEST(DirectionBins, LengthDoesNotMatter) {
    const DirectionBins bins(128);
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const vec3 d = random_direction(i);
        EXPECT_EQ(bins.bin(1e-3F * d), bins.bin(1e4F * d));
    }
}

TEST(DirectionBins, NoBorderOnAnAxis) {
    // Walls are parallel to the axes: rounding must not throw their links from bin to bin.
    for (const int count : {32, 64, 128, 256, 512, 1024}) {
        const DirectionBins bins(count);
        for (int axis = 0; axis < 3; ++axis) {
            for (const float sign : {-1.0F, 1.0F}) {
                vec3 d(0);
                d[axis] = sign;
                for (std::uint32_t i = 0; i < 100; ++i)
                    EXPECT_EQ(bins.bin(d + 1e-4F * random_direction(i)), bins.bin(d)) << count;
            }
        }
    }
}

TEST(DirectionBins, ProjectedSolidAnglesAddUpToPi) {
    for (const int count : {32, 128, 1024}) {
        const DirectionBins bins(count);
        for (std::uint32_t i = 0; i < 20; ++i) {
            const vec3 n = i < 3 ? vec3(i == 0, i == 1, i == 2) : random_direction(i);
            const std::vector<float> c = bins.projected_solid_angles(n);
            const float floor = 1e-3F * bins.mean_solid_angle();
            EXPECT_GT(*std::min_element(c.begin(), c.end()), 0.5F * floor);
            // The floors of the bins behind the surface add up to at most 1e-3 * 4 pi; half the
            // sphere lies behind. Integration over 9,600 texels is good to 1e-3.
            EXPECT_NEAR(std::accumulate(c.begin(), c.end(), 0.0F), kPi + 1e-3F * 2 * kPi,
                        2e-3F * kPi)
                << count;
        }
    }
}

TEST(DirectionBins, OppositeSidesShareASphere) {
    // Light that arrives along d.n < 0: C of n and of -n split |d.n| between them.
    const DirectionBins bins(64);
    const vec3 n = random_direction(5);
    const std::vector<float> front = bins.projected_solid_angles(n);
    const std::vector<float> back = bins.projected_solid_angles(-n);
    for (int b = 0; b < 64; ++b) {
        const auto k = static_cast<std::size_t>(b);
        const float cosine = glm::dot(bins.axis(b), n);
        if (std::abs(cosine) < 0.4F) continue;  // the bin crosses the horizon
        EXPECT_GT(cosine < 0 ? front[k] : back[k], 100 * (cosine < 0 ? back[k] : front[k]));
    }
}

TEST(DirectionBins, CountsOutOfRangeAreRefused) {
    EXPECT_THROW(DirectionBins(31), SceneError);
    EXPECT_THROW(DirectionBins(1025), SceneError);
}

}  // namespace
}  // namespace antiradiance
