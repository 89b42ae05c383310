// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/blocking_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

#include "links/cut_links.h"
#include "support/linked_scene.h"
#include "support/scene_builder.h"

namespace antiradiance {
namespace {

constexpr float kEpsilon = 1e-5F;

BlockingPlanes planes_of(const Scene& scene) {
    return {scene.blockers, kEpsilon};
}

// Two squares across the x axis: "Near" at x = 1, "Far" at x = 2, both [-1, 1]^2.
Scene two_planes() {
    Scene scene;
    for (const auto& [name, x] : {std::pair{"Near", 1.0F}, {"Far", 2.0F}})
        test::add_plane(scene, name, {x, -1, -1}, {0, 2, 0}, {0, 0, 2});
    return scene;
}

TEST(BlockingPlanes, NoneCutsNothing) {
    const BlockingPlanes none;
    EXPECT_TRUE(none.empty());
    EXPECT_EQ(none.crossed({0, 0, 0}, {3, 0, 0}), kNone);
    EXPECT_FALSE(none.near(vec3(0), 1e9F));
}

TEST(BlockingPlanes, TheFirstOnTheWayCuts) {
    const BlockingPlanes planes = planes_of(two_planes());
    EXPECT_EQ(planes.crossed({0, 0.3F, 0.1F}, {3, 0, 0}), 0);
    EXPECT_EQ(planes.crossed({3, 0, 0}, {0, 0.3F, 0.1F}), 1) << "from the other end";
    EXPECT_EQ(planes.crossed({1.5F, 0, 0}, {3, 0, 0}), 1);
    EXPECT_EQ(planes.crossed({0, 0, 0}, {0.9F, 0, 0}), kNone) << "ends before it";
    EXPECT_EQ(planes.crossed({0, 0, 2}, {3, 0, 2}), kNone) << "passes beside";
    EXPECT_EQ(planes.crossed({1, 0, -2}, {1, 0, 2}), kNone) << "lies in it";
}

TEST(BlockingPlanes, AllOnTheWayAreFoundOnce) {
    Scene scene = two_planes();
    Blocker& near = scene.blockers[0];  // twice across the way
    for (int i = 0; i < 4; ++i)
        near.positions.push_back(near.positions[static_cast<std::size_t>(i)] + vec3(0.5F, 0, 0));
    near.triangles.insert(near.triangles.end(), {{4, 5, 6}, {4, 6, 7}});
    const BlockingPlanes planes = planes_of(scene);
    std::vector<BlockerId> found{7};
    planes.all_crossed({0, 0.3F, 0.1F}, {3, 0, 0}, found);
    EXPECT_EQ(found, (std::vector<BlockerId>{0, 1}));
    planes.all_crossed({3, 0, 0}, {0, 0.3F, 0.1F}, found);
    EXPECT_EQ(found, (std::vector<BlockerId>{1, 0}));
    planes.all_crossed({0, 0, 2}, {3, 0, 2}, found);
    EXPECT_TRUE(found.empty());
}

TEST(BlockingPlanes, WhatEndsOnAPlaneDoesNotCrossIt) {
    const BlockingPlanes planes = planes_of(two_planes());
    EXPECT_EQ(planes.crossed({1, 0, 0}, {1.9F, 0.4F, 0}), kNone);
    EXPECT_EQ(planes.crossed({0, 0.2F, 0}, {1, 0, 0}), kNone);
    EXPECT_EQ(planes.crossed({1, 0, 0}, {1, 0, 0}), kNone);
}

TEST(BlockingPlanes, HasNoGapAlongTheEdgesOfItsTriangles) {
    const BlockingPlanes planes = planes_of(two_planes());
    for (int i = -9; i <= 9; ++i) {
        const float t = 0.1F * static_cast<float>(i);
        EXPECT_EQ(planes.crossed({0.5F, t, t}, {1.5F, t, t}), 0) << "on the diagonal, " << t;
        EXPECT_EQ(planes.crossed({0, 0, 0}, {2, 2 * t, 2 * t}), 0) << "slanted, " << t;
    }
}

TEST(BlockingPlanes, AHoleStaysOpen) {
    Scene scene;  // a wall at x = 0 with a door from y = 1 to 2 and 2 high
    test::add_plane(scene, "Left", {0, 0, 0}, {0, 1, 0}, {0, 0, 3});
    test::add_plane(scene, "Right", {0, 2, 0}, {0, 1, 0}, {0, 0, 3});
    test::add_plane(scene, "Above", {0, 1, 2}, {0, 1, 0}, {0, 0, 1});
    const BlockingPlanes planes = planes_of(scene);
    for (float y = 0.05F; y < 3; y += 0.1F) {
        for (float z = 0.05F; z < 3; z += 0.1F) {
            const bool open = y > 1 && y < 2 && z < 2;
            EXPECT_EQ(planes.crossed({-1, y, z}, {1, y, z}) == kNone, open) << y << " " << z;
        }
    }
}

std::array<vec3, 4> square(float x, float half) {
    return {vec3(x, -half, -half), vec3(x, half, -half), vec3(x, half, half), vec3(x, -half, half)};
}

BlockerId separating(const BlockingPlanes& planes, const std::array<vec3, 4>& a,
                     const std::array<vec3, 4>& b) {
    return planes.separating({0.5F * (a[0] + a[2]), a}, {0.5F * (b[0] + b[2]), b});
}

TEST(BlockingPlanes, PartsWhatLiesInTheShadowOfItsOutline) {
    Scene scene;
    test::add_plane(scene, "Plane", {0, -1, -1}, {0, 2, 0}, {0, 0, 2});
    const BlockingPlanes planes = planes_of(scene);
    // From a square of half size a at x = -1 to one of b at x = 1, segments meet x = 0 within
    // (a + b) / 2.
    EXPECT_EQ(separating(planes, square(-1, 1), square(1, 0.99F)), 0);
    EXPECT_EQ(separating(planes, square(-1, 1), square(1, 1.01F)), kNone);
    EXPECT_EQ(separating(planes, square(1, 0.5F), square(2, 0.5F)), kNone) << "on one side";
    EXPECT_TRUE(planes.near({0.5F, 0, 0}, 0.6F));
    EXPECT_FALSE(planes.near({0.5F, 0, 0}, 0.4F));
}

TEST(BlockingPlanes, NearIsByThePlaneNotItsBox) {
    Scene scene;  // across the corner of a room, at 45 degrees
    test::add_plane(scene, "Oblique", {0, 4, 0}, {4, -4, 0}, {0, 0, 3});
    const BlockingPlanes planes = planes_of(scene);
    EXPECT_FALSE(planes.near({0.5F, 0.5F, 1}, 2)) << "inside of its box, 2.1 m away";
    EXPECT_TRUE(planes.near({0.5F, 0.5F, 1}, 2.2F));
    EXPECT_FALSE(planes.near({2, 2, 5}, 1.9F)) << "above it";
}

// One plane of a kilometre must not make the others coarse.
TEST(BlockingPlanes, AFarPlaneClosesNoSlot) {
    Scene scene;
    test::add_plane(scene, "Left", {0, -1, -1}, {0, 0.995F, 0}, {0, 0, 2});
    test::add_plane(scene, "Right", {0, 0.005F, -1}, {0, 0.995F, 0}, {0, 0, 2});
    test::add_plane(scene, "Far", {5e3F, 0, 0}, {0, 1e3F, 0}, {0, 0, 1e3F});
    const BlockingPlanes planes = planes_of(scene);
    EXPECT_EQ(planes.crossed({-1, 0, 0}, {1, 0, 0}), kNone);
    EXPECT_EQ(planes.crossed({-1, 0.01F, 0}, {1, 0.01F, 0}), 1);
    EXPECT_EQ(separating(planes, square(-1, 0.1F), square(1, 0.2F)), kNone) << "past the slot";
}

TEST(BlockingPlanes, AFoldedMeshPartsOnlyWithOneOfItsPlanes) {
    Scene scene;  // a roof: two squares that meet at z = 0, in one object
    test::add_plane(scene, "Roof", {0, -1, -1}, {0, 2, 0}, {0.5F, 0, 1});
    Blocker& roof = scene.blockers[0];
    roof.positions.insert(roof.positions.end(), {{0, -1, 1}, {0, 1, 1}});
    roof.triangles.insert(roof.triangles.end(), {{3, 2, 5}, {3, 5, 4}});
    const BlockingPlanes planes = planes_of(scene);
    EXPECT_EQ(planes.crossed({-1, 0, 0.5F}, {2, 0, 0.5F}), 0);
    EXPECT_EQ(separating(planes, square(-1, 0.1F), square(2, 0.1F)), kNone) << "at the ridge";
    std::array<vec3, 4> high_a = square(-1, 0.1F);
    std::array<vec3, 4> high_b = square(2, 0.1F);
    for (int i = 0; i < 4; ++i) {
        high_a[static_cast<std::size_t>(i)].z += 0.5F;
        high_b[static_cast<std::size_t>(i)].z += 0.5F;
    }
    EXPECT_EQ(separating(planes, high_a, high_b), 0);
}

// ------------------------------------------------------------------------------------- link meshes

// Floating sheets on both sides of x = 2, none across it.
Scene sheets() {
    Scene scene;
    const int grey = test::add_material(scene, vec3(0.5F));
    test::add_box(scene, "Left", {0, 0, 0}, {1.9F, 2, 2}, grey, test::Facing::kInward);
    test::add_box(scene, "Right", {2.1F, 0, 0}, {4, 2, 2}, grey, test::Facing::kInward);
    test::add_box(scene, "Block", {2.5F, 0.5F, 0.5F}, {3, 1.1F, 1.2F}, grey);
    return scene;
}

using Key = std::tuple<NodeId, NodeId, int, float>;

std::multiset<Key> keys_of(const std::vector<RawLink>& links, const std::vector<BlockerId>& cut) {
    std::multiset<Key> keys;
    for (std::size_t l = 0; l < links.size(); ++l) {
        if (cut[l] == kNone)
            keys.emplace(links[l].source, links[l].receiver, links[l].bin, links[l].form_factor);
    }
    return keys;
}

class SeparatedPairs : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(, SeparatedPairs, testing::Bool(), [](const auto& info) {
    return std::string(info.param ? "WithAntiradiance" : "RadianceOnly");
});

// On a mesh that does not grow, pairs that are dropped whole and links that are cut one by one make
// up what cutting one by one finds.
TEST_P(SeparatedPairs, AreWhatWouldBeCut) {
    Scene scene = sheets();
    test::add_plane(scene, "Part", {2, 0, 0}, {0, 1.3F, 0}, {0, 0, 1.7F});
    test::add_plane(scene, "Rest", {2, 1.3F, 0}, {0, 0.7F, 0}, {0, 0, 1.7F});
    const BlockingPlanes planes = planes_of(scene);
    RefineOptions options;
    options.least_edge = 10;
    options.antiradiance = GetParam();
    const test::LinkedScene all(scene, 0.6F, options);
    options.planes = &planes;
    const test::LinkedScene parted(scene, 0.6F, options);

    Progress progress;
    const auto cut_of = [&](const test::LinkedScene& linked) {
        return find_cut_links(linked.tree, linked.refined.links, planes, progress);
    };
    const std::vector<BlockerId> cut_of_all = cut_of(all);
    const std::vector<BlockerId> cut_of_rest = cut_of(parted);
    EXPECT_EQ(keys_of(parted.refined.links, cut_of_rest), keys_of(all.refined.links, cut_of_all));

    const auto count = [](const std::vector<BlockerId>& cut) {
        return static_cast<std::size_t>(
            std::ranges::count_if(cut, [](BlockerId plane) { return plane != kNone; }));
    };
    std::size_t dropped = 0;
    for (const SeparatedPair& pair : parted.refined.separated)
        dropped += pair.links.total();
    EXPECT_GT(dropped, count(cut_of_rest)) << "most of them need not be made";
    EXPECT_GT(count(cut_of_rest), 0U);
    // Links that turn out to carry nothing are counted as well, and those of touching pairs, which
    // are spread over several bins, once.
    const auto all_cut = static_cast<double>(count(cut_of_all));
    EXPECT_NEAR(static_cast<double>(dropped + count(cut_of_rest)), all_cut, 0.05 * all_cut);
}

TEST(FindCutLinks, SortedLinksAreCutAlike) {
    Scene scene = sheets();
    test::add_plane(scene, "Part", {2, 0, 0}, {0, 1.3F, 0}, {0, 0, 1.7F});
    const BlockingPlanes planes = planes_of(scene);
    const test::LinkedScene linked(scene, 0.6F, {.least_edge = 0.3F});
    Progress progress;
    const std::vector<BlockerId> raw =
        find_cut_links(linked.tree, linked.refined.links, planes, progress);
    const std::vector<BlockerId> sorted =
        find_cut_links(linked.tree, linked.sorted(), planes, progress);
    EXPECT_EQ(raw.size(), sorted.size());
    EXPECT_EQ(std::ranges::count(raw, 0), std::ranges::count(sorted, 0));
    EXPECT_GT(std::ranges::count(raw, 0), 0);
}

// A cluster on both sides of a plane is no end of a link: its centre would decide for all of it.
TEST(FindCutLinks, ClustersAreRefinedAtAPlane) {
    Scene scene;
    const int grey = test::add_material(scene, vec3(0.5F));
    for (int i = 0; i < 40; ++i) {
        const float x = 0.1F * static_cast<float>(i % 20) + 0.02F;
        const float y = i < 20 ? 0.0F : 40.0F;
        test::add_quad(scene, "Sheet", {x, y, 0}, {0.05F, 0, 0}, {0, 0, 0.05F}, grey);
        test::add_quad(scene, "Back", {x, y, 0}, {0, 0, 0.05F}, {0.05F, 0, 0}, grey);
    }
    test::add_plane(scene, "Plane", {1, -1, -1}, {0, 42, 0}, {0, 0, 2});
    const BlockingPlanes planes = planes_of(scene);
    RefineOptions options;
    options.cluster_links = true;
    options.antiradiance = false;
    options.least_edge = 1;
    options.planes = &planes;
    const test::LinkedScene linked(scene, 1, options, 32);
    int clusters = 0;
    for (const RawLink& l : linked.refined.links) {
        for (const NodeId n : {l.source, l.receiver}) {
            if (!linked.tree.is_cluster(n)) continue;
            ++clusters;
            const auto i = static_cast<std::size_t>(n);
            EXPECT_GE(std::abs(linked.tree.center[i].x - 1), linked.tree.radius[i]);
        }
    }
    EXPECT_GT(clusters, 0);
}

}  // namespace
}  // namespace antiradiance
