// SPDX-License-Identifier: GPL-3.0-or-later
#include "hierarchy/scene_change.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "base/random.h"
#include "support/scene_builder.h"
#include "support/tree_builder.h"

namespace antiradiance {
namespace {

vec3 random_vector(std::uint32_t seed) {
    return {to_unit_float(hash_u32(3 * seed)), to_unit_float(hash_u32(3 * seed + 1)),
            to_unit_float(hash_u32(3 * seed + 2))};
}

Box random_box(std::uint32_t seed) {
    const vec3 corner = 4.0F * random_vector(2 * seed);
    return {corner, corner + random_vector(2 * seed + 1)};
}

vec3 point_of(const Box& box, std::uint32_t seed) {
    return glm::mix(box.low, box.high, random_vector(seed));
}

bool holds(const Box& box, const vec3& p) {
    return glm::all(glm::lessThanEqual(box.low, p)) && glm::all(glm::lessThanEqual(p, box.high));
}

TEST(MayCross, NoSegmentMeetsWhatIsSaidToBeClear) {
    int clear = 0;
    for (std::uint32_t i = 0; i < 3000; ++i) {
        const Box from = random_box(3 * i);
        const Box to = random_box(3 * i + 1);
        const Box obstacle = random_box(3 * i + 2);
        if (may_cross(from, to, obstacle)) continue;
        ++clear;
        for (std::uint32_t k = 0; k < 50; ++k) {
            const vec3 a = point_of(from, hash_combine(i, 2 * k));
            const vec3 b = point_of(to, hash_combine(i, 2 * k + 1));
            for (int step = 0; step <= 20; ++step)
                ASSERT_FALSE(holds(obstacle, glm::mix(a, b, static_cast<float>(step) / 20)));
        }
    }
    EXPECT_GT(clear, 1000) << "a test of nothing";
}

TEST(MayCross, WhatLiesBesideTheTaperedHullIsClear) {
    const Box wide{vec3(0, 0, 0), vec3(2, 2, 0)};
    const Box point{vec3(1, 1, 2), vec3(1, 1, 2)};
    // At half the way the hull is half as wide: [.5, 1.5].
    EXPECT_TRUE(may_cross(wide, point, {vec3(1.4F, 1, 1), vec3(3, 1, 1)}));
    EXPECT_FALSE(may_cross(wide, point, {vec3(1.6F, 1, 1), vec3(3, 1, 1)}));
    EXPECT_FALSE(may_cross(wide, point, {vec3(1, 1, 2.1F), vec3(1, 1, 3)}));
}

// A floor, a far wall and a box of a half metre that stands on the floor.
struct Room {
    Scene scene;
    PatchTree tree;

    explicit Room(float x, bool box = true) {
        const int white = test::add_material(scene, vec3(0.5F));
        test::add_quad(scene, "floor", vec3(0), vec3(4, 0, 0), vec3(0, 4, 0), white);
        if (box) test::add_box(scene, "box", vec3(x, 1, 0), vec3(x + 0.5F, 1.5F, 0.5F), white);
        test::add_quad(scene, "wall", vec3(0, 4, 0), vec3(4, 0, 0), vec3(0, 0, 2), white);
        tree = test::front_tree(scene, 0.5F);
    }
};

std::string object_of(const Room& room, NodeId leaf) {
    const SurfaceId s = room.tree.surface[static_cast<std::size_t>(leaf)];
    return room.scene
        .objects[static_cast<std::size_t>(room.tree.surfaces[static_cast<std::size_t>(s)].object)]
        .name;
}

TEST(SceneChange, FindsThePatchesThatStayed) {
    const Room was(1);
    const Room is(2);
    const SceneChange change(was.scene, was.tree, is.scene, is.tree);
    for (const NodeId leaf : is.tree.leaves) {
        const NodeId twin = change.earlier(leaf);
        if (object_of(is, leaf) == "box") {
            EXPECT_EQ(twin, kNone);
            continue;
        }
        ASSERT_NE(twin, kNone);
        EXPECT_EQ(object_of(was, twin), object_of(is, leaf));
        EXPECT_EQ(was.tree.center[static_cast<std::size_t>(twin)],
                  is.tree.center[static_cast<std::size_t>(leaf)]);
        EXPECT_EQ(was.tree.normal[static_cast<std::size_t>(twin)],
                  is.tree.normal[static_cast<std::size_t>(leaf)]);
    }
}

TEST(SceneChange, BlocksWhereAnObjectWasAndIs) {
    const auto line = [](float x, float z) {
        return std::pair(Box{vec3(x, 0, z), vec3(x, 0, z)}, Box{vec3(x, 4, z), vec3(x, 4, z)});
    };
    const auto crossed = [&](const Room& was, const Room& is, float x, float z) {
        const SceneChange change(was.scene, was.tree, is.scene, is.tree);
        const auto [from, to] = line(x, z);
        return change.may_be_between(from, to);
    };
    const Room none(0, false);
    const Room one(1);
    const Room two(2);
    EXPECT_TRUE(crossed(one, two, 1.2F, 0.2F)) << "where it was";
    EXPECT_TRUE(crossed(one, two, 2.2F, 0.2F)) << "where it is";
    EXPECT_FALSE(crossed(one, two, 1.8F, 0.2F)) << "between the two";
    EXPECT_FALSE(crossed(one, two, 1.2F, 0.7F)) << "above it";
    EXPECT_TRUE(crossed(none, one, 1.2F, 0.2F)) << "it came";
    EXPECT_TRUE(crossed(one, none, 1.2F, 0.2F)) << "it went";
    EXPECT_FALSE(crossed(one, one, 1.2F, 0.2F)) << "it stayed";
}

TEST(SceneChange, SkyIsCrossedAlongItsCone) {
    const Room was(1);
    const Room is(2);
    const SceneChange change(was.scene, was.tree, is.scene, is.tree);
    const Box below{vec3(2.2F, 1.2F, -1), vec3(2.2F, 1.2F, -1)};
    const Box beside{vec3(3.5F, 1.2F, -1), vec3(3.5F, 1.2F, -1)};
    EXPECT_TRUE(change.may_be_before_sky(below, vec3(0, 0, 1), 0.01F));
    EXPECT_FALSE(change.may_be_before_sky(beside, vec3(0, 0, 1), 0.01F));
    EXPECT_TRUE(change.may_be_before_sky(beside, glm::normalize(vec3(-1, 0, 1)), 0.01F));
    EXPECT_TRUE(change.may_be_before_sky(beside, vec3(0, 0, 1), 0.9F)) << "a wide cone";
    EXPECT_FALSE(change.may_be_before_sky(below, vec3(0, 0, -1), 0.01F));
}

}  // namespace
}  // namespace antiradiance
