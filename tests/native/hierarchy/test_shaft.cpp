// SPDX-License-Identifier: GPL-3.0-or-later
#include "hierarchy/shaft.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "support/scene_builder.h"
#include "support/tree_builder.h"

namespace antiradiance {
namespace {

// One region: the square [-size, size]^2 of the plane z = 0.
ConvexRegions square(float size) {
    Scene scene;
    test::add_quad(scene, "Screen", {-size, -size, 0}, {2 * size, 0, 0}, {0, 2 * size, 0},
                   test::add_material(scene, vec3(0.5F)));
    return find_convex_regions(scene, test::front_surfaces(scene));
}

std::vector<vec3> quad(float x, float y, float z, float size) {
    return {{x - size, y - size, z},
            {x + size, y - size, z},
            {x + size, y + size, z},
            {x - size, y + size, z}};
}

TEST(ShaftTest, KnowsTheEdgeOfTheShadow) {
    // From squares of half size a at z = 1 and b at z = -1, segments meet z = 0 in a square of half
    // size (a + b) / 2.
    const ConvexRegions screen = square(1);
    ShaftTest test(screen);
    EXPECT_TRUE(test.blocks(0, quad(0, 0, 1, 1.5F), quad(0, 0, -1, 0.49F)));
    EXPECT_FALSE(test.blocks(0, quad(0, 0, 1, 1.5F), quad(0, 0, -1, 0.51F)));
    EXPECT_TRUE(test.blocks(0, quad(0, 0, -1, 0.49F), quad(0, 0, 1, 1.5F))) << "either way";
    // At z = -3 the receiver counts for a quarter.
    EXPECT_TRUE(test.blocks(0, quad(0, 0, 1, 0.5F), quad(0, 0, -3, 2.45F)));
    EXPECT_FALSE(test.blocks(0, quad(0, 0, 1, 0.5F), quad(0, 0, -3, 2.55F)));
}

TEST(ShaftTest, OnlyBetweenThem) {
    const ConvexRegions screen = square(10);
    ShaftTest test(screen);
    EXPECT_FALSE(test.blocks(0, quad(0, 0, 1, 0.1F), quad(0, 0, 2, 0.1F)));
    EXPECT_FALSE(test.blocks(0, quad(0, 0, 1, 0.1F), quad(0, 0, 0, 0.1F))) << "lies in the plane";
    const std::vector<vec3> through{{0, 0, 1}, {1, 0, 1}, {1, 0, -1}, {0, 0, -1}};
    EXPECT_FALSE(test.blocks(0, through, quad(0, 0, -2, 0.1F))) << "pierces the plane";
}

TEST(ShaftTest, MayTouchTheScreen) {
    // A wall that stands on the receiver: one edge of the receiver lies in its plane.
    const ConvexRegions screen = square(1);
    ShaftTest test(screen);
    const std::vector<vec3> floor{
        {-0.5F, -1, 0}, {0.5F, -1, 0}, {0.5F, -1, 0.7F}, {-0.5F, -1, 0.7F}};
    EXPECT_TRUE(test.blocks(0, floor, quad(0, 0, -1, 0.3F)));
    const std::vector<vec3> gap{
        {-0.5F, -1.01F, 0}, {0.5F, -1.01F, 0}, {0.5F, -1.01F, 0.7F}, {-0.5F, -1.01F, 0.7F}};
    EXPECT_FALSE(test.blocks(0, gap, quad(0, 0, -1, 0.3F))) << "light comes in below";
}

TEST(ShaftTest, NoSegmentOfABlockedPairIsFree) {
    const ConvexRegions screen = square(1);
    ShaftTest test(screen);
    int blocked = 0;
    for (std::uint32_t i = 0; i < 20'000; ++i) {
        std::uint32_t seed = hash_u32(i);
        const auto random = [&] { return to_unit_float(seed = hash_u32(seed + 1)) * 2 - 1; };
        std::vector<vec3> a, b;
        for (int k = 0; k < 4; ++k) {
            a.emplace_back(random(), random(), 0.2F + std::abs(random()));
            b.emplace_back(random(), random(), -0.2F - std::abs(random()));
        }
        if (!test.blocks(0, a, b)) continue;
        ++blocked;
        for (int k = 0; k < 100; ++k) {
            const auto inside = [&](const std::vector<vec3>& hull) {
                const vec3 p = glm::mix(hull[0], hull[1], 0.5F + 0.5F * random());
                const vec3 q = glm::mix(hull[2], hull[3], 0.5F + 0.5F * random());
                return glm::mix(p, q, 0.5F + 0.5F * random());
            };
            const vec3 p = inside(a);
            const vec3 q = inside(b);
            const vec3 at = glm::mix(p, q, p.z / (p.z - q.z));
            ASSERT_LE(std::max(std::abs(at.x), std::abs(at.y)), 1 + 1e-5F);
        }
    }
    EXPECT_GT(blocked, 1000);
}

}  // namespace
}  // namespace antiradiance
