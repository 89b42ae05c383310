// SPDX-License-Identifier: GPL-3.0-or-later
#include "prune/dark_links.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hand_made_links.h"
#include "hierarchy/patch_materials.h"
#include "support/linked_scene.h"
#include "support/scenes.h"

namespace antiradiance {
namespace {

// Four quads in a row, each of which lights the next: A -> B -> C -> D, and passes antiradiance on.
struct Row : test::HandMadeLinks {
    Row() {
        for (int i = 0; i < 4; ++i)
            add(kNames[i], static_cast<float>(i), vec2(0), vec2(1), false);
        make_tree(0.6F);
        source.assign(tree.size(), vec3(0));
        albedo.assign(tree.size(), vec3(0.5F));
        for (int i = 0; i < 3; ++i) {
            plus(node(kNames[i]), node(kNames[i + 1]));
            minus(node(kNames[i]), node(kNames[i + 1]));
        }
    }
    void set(std::vector<vec3>& values, const char* name, const vec3& value) const {
        const auto n = static_cast<std::size_t>(node(name));
        std::fill(values.begin() + node(name), values.begin() + tree.subtree_end[n], value);
    }
    [[nodiscard]] LinkSet left() const {
        Progress progress;
        const LinkSet all = links();
        return remove_links(all, find_dark_links(tree, all, source, albedo, progress));
    }
    [[nodiscard]] bool plus_left(const char* from, const char* to) const {
        return test::holds_plus(left(), node(from), node(to));
    }
    [[nodiscard]] bool minus_left(const char* from, const char* to) const {
        return test::holds_minus(left(), node(from), node(to));
    }
    static constexpr const char* kNames[] = {"A", "B", "C", "D"};
    std::vector<vec3> source, albedo;
};

TEST(DarkLinks, FollowTheLightFromBounceToBounce) {
    Row row;
    EXPECT_TRUE(row.left().links.empty()) << "nothing is lit";
    row.set(row.source, "B", vec3(0, 0, 1));
    EXPECT_FALSE(row.plus_left("A", "B"));
    EXPECT_FALSE(row.minus_left("A", "B"));
    EXPECT_TRUE(row.plus_left("B", "C"));
    EXPECT_FALSE(row.minus_left("B", "C")) << "B sends light but receives none over links";
    EXPECT_TRUE(row.plus_left("C", "D"));
    EXPECT_TRUE(row.minus_left("C", "D"));
}

TEST(DarkLinks, BlackPatchesPassAntiradianceOnly) {
    Row row;
    row.set(row.source, "A", vec3(1));
    row.set(row.albedo, "C", vec3(0));
    EXPECT_TRUE(row.plus_left("B", "C"));
    EXPECT_FALSE(row.plus_left("C", "D"));
    EXPECT_TRUE(row.minus_left("C", "D"));
}

TEST(DarkLinks, OneLitLeafLightsTheLinksAbove) {
    Row row;
    const NodeId leaf = row.leaf("A", {0.1F, 0.1F, 0});
    ASSERT_NE(leaf, row.node("A"));
    row.source[static_cast<std::size_t>(leaf)] = vec3(1);
    EXPECT_TRUE(row.plus_left("A", "B"));
    // Light that arrives at a patch arrives at all below it.
    row.raw.clear();
    row.plus(leaf, row.node("B"));
    row.plus(row.node("B") + 1, row.node("C"));
    row.plus(row.leaf("A", {0.9F, 0.9F, 0}), row.node("D"));
    EXPECT_EQ(row.left().links.size(), 2U);
}

TEST(DarkLinks, WhatOnlyAntiradianceReachesIsDark) {
    Row row;
    row.set(row.source, "A", vec3(1));
    row.raw.erase(row.raw.begin() + 2);  // B -> C, the + link
    EXPECT_TRUE(row.minus_left("B", "C"));
    EXPECT_FALSE(row.plus_left("C", "D"));
    EXPECT_FALSE(row.minus_left("C", "D"));
}

TEST(DarkLinks, InALitRoomThereAreNone) {
    const Scene scene = test::floating_boxes(2);
    const test::LinkedScene linked(scene, 0.8F, {.link_threshold = 0.05F, .least_edge = 0.4F});
    const LinkSet links = linked.sorted();
    Progress progress;
    const std::vector<vec3> grey(linked.tree.size(), vec3(0.5F));
    const std::vector<vec3> emission = average_materials(scene, linked.tree).emission;
    const RemovedLinks removed = find_dark_links(linked.tree, links, emission, grey, progress);
    EXPECT_EQ(std::count(removed.begin(), removed.end(), 1), 0);
}

}  // namespace
}  // namespace antiradiance
