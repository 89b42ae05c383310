// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "base/random.h"

namespace antiradiance {
namespace {

TEST(SceneError, lists_one_problem_a_line) {
    EXPECT_STREQ(SceneError(std::vector<std::string>{"Cube: a", "Lamp: b"}).what(),
                 "Cube: a\nLamp: b");
}

TEST(Progress, maps_a_stage_onto_its_part_of_the_bar) {
    std::vector<float> fractions;
    std::vector<std::string> stages;
    Progress progress(
        [&](float fraction, const std::string& stage) {
            fractions.push_back(fraction);
            stages.push_back(stage);
        },
        nullptr);
    progress.begin_stage("solve", 0.5F, 0.9F);
    progress.report(0.25F);
    progress.report(7);  // a stage that overshoots must not
    EXPECT_EQ(fractions, (std::vector<float>{0.5F, 0.6F, 0.9F}));
    EXPECT_EQ(stages, (std::vector<std::string>(3, "solve")));
}

TEST(Progress, a_wish_to_stop_ends_in_cancelled_on_every_later_check) {
    bool wish = false;
    Progress progress(nullptr, [&] { return wish; });
    EXPECT_NO_THROW(progress.report(0));
    wish = true;
    EXPECT_NO_THROW(progress.check());  // nobody asked the caller yet
    EXPECT_THROW(progress.report(0), Cancelled);
    wish = false;  // too late
    EXPECT_THROW(progress.check(), Cancelled);
    EXPECT_TRUE(progress.cancelled());
}

TEST(random, unit_floats_stay_below_one) {
    EXPECT_EQ(to_unit_float(0), 0);
    EXPECT_LT(to_unit_float(0xffffffffU), 1);
}

TEST(random, frames_are_right_handed_and_orthonormal) {
    for (std::uint32_t i = 0; i < 200; ++i) {
        const vec2 u = r2_sample(i, 1);
        const float z = 2 * u.x - 1;
        const float r = std::sqrt(1 - z * z);
        // The poles too: at n.z = -1 the basis changes its branch.
        const vec3 n = i == 0   ? vec3(0, 0, 1)
                       : i == 1 ? vec3(0, 0, -1)
                                : vec3(r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z);
        const Frame frame(n);
        EXPECT_NEAR(glm::dot(frame.t, frame.s), 0, 1e-5F);
        EXPECT_NEAR(glm::length(frame.t), 1, 1e-5F);
        EXPECT_NEAR(glm::length(glm::cross(frame.t, frame.s) - n), 0, 1e-5F);
        EXPECT_NEAR(glm::length(frame.to_world({0, 0, 1}) - n), 0, 1e-6F);
    }
}

// Quasi-random points in a rectangle of area a: the error of their share is of order log(n) / n.
constexpr std::uint32_t kSamples = 4096;
constexpr float kQuasiRandomTolerance = 0.005F;

TEST(random, r2_points_fill_the_unit_square_evenly) {
    for (const std::uint32_t seed : {0U, 1U, 77U}) {
        int inside = 0;
        for (std::uint32_t i = 0; i < kSamples; ++i) {
            const vec2 u = r2_sample(i, seed);
            ASSERT_TRUE(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1);
            inside += u.x < 0.3F && u.y > 0.5F ? 1 : 0;
        }
        EXPECT_NEAR(static_cast<float>(inside) / kSamples, 0.15F, kQuasiRandomTolerance);
    }
}

TEST(random, disk_points_are_uniform) {
    int inside_half = 0;
    vec2 mean(0);
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const vec2 d = concentric_disk(r2_sample(i, 3));
        ASSERT_LE(glm::length(d), 1 + 1e-6F);
        inside_half += glm::length(d) < 0.5F ? 1 : 0;
        mean += d / static_cast<float>(kSamples);
    }
    EXPECT_NEAR(static_cast<float>(inside_half) / kSamples, 0.25F, kQuasiRandomTolerance);
    EXPECT_NEAR(glm::length(mean), 0, kQuasiRandomTolerance);
}

TEST(random, hemisphere_directions_have_cosine_density) {
    // With density cos / pi: E[cos] = 2/3 and E[cos^2] = 1/2.
    double cosine = 0;
    double cosine2 = 0;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const vec3 w = cosine_hemisphere(r2_sample(i, 5));
        ASSERT_NEAR(glm::length(w), 1, 1e-5F);
        ASSERT_GE(w.z, 0);
        cosine += w.z / kSamples;
        cosine2 += w.z * w.z / kSamples;
    }
    EXPECT_NEAR(cosine, 2.0 / 3.0, kQuasiRandomTolerance);
    EXPECT_NEAR(cosine2, 0.5, kQuasiRandomTolerance);
}

TEST(random, hashes_spread_neighbours) {
    // Each output bit flips with probability 1/2 when one input bit flips; "lowbias32" keeps
    // within .2 % of it over all inputs, 4,000 tries leave +-2.5 % (3 sigma).
    int flips = 0;
    for (std::uint32_t i = 0; i < 125; ++i) {
        for (std::uint32_t bit = 0; bit < 32; ++bit) {
            const std::uint32_t a = hash_combine(i, 9);
            const std::uint32_t b = hash_combine(i ^ (1U << bit), 9);
            flips += __builtin_popcount(a ^ b);
        }
    }
    EXPECT_NEAR(flips / (4000.0 * 32.0), 0.5, 0.025);
}

}  // namespace
}  // namespace antiradiance
