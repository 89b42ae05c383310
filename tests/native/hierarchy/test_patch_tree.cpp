// SPDX-License-Identifier: GPL-3.0-or-later
#include "hierarchy/patch_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.h"
#include "hierarchy/growing_tree.h"
#include "hierarchy/patch_materials.h"
#include "hierarchy/push_pull.h"
#include "support/scene_builder.h"
#include "support/scenes.h"
#include "support/tree_builder.h"

namespace antiradiance {
namespace {

std::size_t at(NodeId n) {
    return static_cast<std::size_t>(n);
}

// The office with a slanted triangle and a trapezium, both sides of everything.
Scene scene_of_all_shapes() {
    Scene scene = test::office();
    test::add_polygon(scene, "Triangle", {{0.3F, 0.3F, 1}, {1.2F, 0.4F, 1.3F}, {0.5F, 2, 1.8F}}, 0);
    test::add_polygon(scene, "Trapezium", {{4, 3, 1}, {5.5F, 3, 1}, {5, 3.5F, 1}, {4.2F, 3.5F, 1}},
                      0);
    return scene;
}

struct Made {
    Scene scene = scene_of_all_shapes();
    PatchTree tree;
    explicit Made(float max_edge) {
        std::vector<Surface> surfaces;
        for (const Polygon& p : make_polygons(scene)) {
            surfaces.push_back(make_surface(scene, p, false));
            surfaces.push_back(make_surface(scene, p, true));
        }
        GrowingTree growing(std::move(surfaces));
        growing.split_to(max_edge);
        std::vector<NodeId> number;
        tree = growing.finish(scene, number);
        EXPECT_EQ(number.size(), tree.size());
    }
};

TEST(PatchTree, IsInPreorder) {
    const Made made(0.5F);
    const PatchTree& t = made.tree;
    EXPECT_EQ(t.parent[0], kNone);
    EXPECT_EQ(t.subtree_end[0], static_cast<NodeId>(t.size()));
    std::vector<NodeId> leaves;
    for (NodeId n = 0; n < static_cast<NodeId>(t.size()); ++n) {
        if (n > 0) {
            const NodeId p = t.parent[at(n)];
            ASSERT_LT(p, n);
            ASSERT_LE(t.subtree_end[at(n)], t.subtree_end[at(p)]);
            ASSERT_EQ(t.depth[at(n)], t.depth[at(p)] + 1);
            // A patch's children are patches of its surface; no cluster lies below a patch.
            if (!t.is_cluster(p)) {
                ASSERT_EQ(t.surface[at(n)], t.surface[at(p)]);
            }
        }
        if (t.is_leaf(n)) {
            ASSERT_FALSE(t.is_cluster(n));
            leaves.push_back(n);
        }
    }
    EXPECT_EQ(leaves, t.leaves);
    for (SurfaceId s = 0; s < static_cast<SurfaceId>(t.surfaces.size()); ++s) {
        const NodeId n = t.surface_node[at(s)];
        ASSERT_EQ(t.surface[at(n)], s);
        ASSERT_TRUE(t.is_cluster(t.parent[at(n)]));
        ASSERT_NEAR(t.area[at(n)], surface_area(t.surfaces[at(s)]), 1e-4F * t.area[at(n)]);
    }
}

TEST(PatchTree, ChildrenShareTheirParentsAreaAndLieInItsSphere) {
    const Made made(0.5F);
    const PatchTree& t = made.tree;
    std::vector<float> children(t.size(), 0);
    for (std::size_t n = t.size(); n-- > 1;) {
        const auto p = at(t.parent[n]);
        children[p] += t.area[n];
        // Spheres hold the patches: all corners of all leaves below.
        if (t.is_leaf(static_cast<NodeId>(n))) {
            const auto corners = t.patch_corners(static_cast<NodeId>(n));
            for (NodeId up = static_cast<NodeId>(n); up != kNone; up = t.parent[at(up)]) {
                for (int i = 0; i < t.corner_count(static_cast<NodeId>(n)); ++i) {
                    ASSERT_LE(glm::distance(corners[at(i)], t.center[at(up)]),
                              t.radius[at(up)] * 1.0001F + 1e-5F);
                }
                ASSERT_GE(glm::dot(t.normal[n], t.normal[at(up)]), t.cone_cosine[at(up)] - 1e-4F);
            }
        }
    }
    for (std::size_t n = 0; n < t.size(); ++n) {
        if (!t.is_leaf(static_cast<NodeId>(n))) {
            ASSERT_NEAR(children[n] / t.area[n], 1, 1e-3F);
        }
    }
}

TEST(PatchTree, SplitsToTheLengthAskedFor) {
    for (const float max_edge : {2.0F, 0.6F, 0.25F}) {
        const Made made(max_edge);
        const PatchTree& t = made.tree;
        for (const NodeId leaf : t.leaves) {
            const auto c = t.patch_corners(leaf);
            const int count = t.corner_count(leaf);
            for (int i = 0; i < count; ++i)
                ASSERT_LE(glm::distance(c[at(i)], c[at((i + 1) % count)]), max_edge * 1.0001F);
        }
    }
}

TEST(PatchTree, LookupFindsTheLeafThatHoldsThePoint) {
    const Made made(0.4F);
    const PatchTree& t = made.tree;
    for (std::uint32_t i = 0; i < 20'000; ++i) {
        const auto triangle = static_cast<TriangleId>(
            hash_u32(i) % static_cast<std::uint32_t>(made.scene.triangles.size()));
        const bool back = (hash_u32(i ^ 0x1234U) & 1U) != 0;
        vec2 b = r2_sample(i, 5);
        if (b.x + b.y > 1) b = 1.0F - b;
        const auto c = made.scene.corners(triangle);
        const vec3 point = c[0] * (1 - b.x - b.y) + c[1] * b.x + c[2] * b.y;
        const NodeId leaf = t.lookup(triangle, back, point);
        ASSERT_NE(leaf, kNone);
        ASSERT_TRUE(t.is_leaf(leaf));
        const Surface& s = t.surfaces[at(t.surface[at(leaf)])];
        ASSERT_EQ(s.back_side, back);
        ASSERT_TRUE(s.triangles[0] == triangle || s.triangles[1] == triangle);
        const auto corners = t.patch_corners(leaf);
        const int count = t.corner_count(leaf);
        for (int k = 0; k < count; ++k) {
            const vec3 edge = corners[at((k + 1) % count)] - corners[at(k)];
            const float outside =
                -glm::dot(glm::cross(edge, point - corners[at(k)]), t.normal[at(leaf)]) /
                glm::length(edge);
            ASSERT_LT(outside, 1e-4F) << "m beyond an edge of its leaf";
        }
    }
}

TEST(PatchTree, LookupKnowsUnlitSides) {
    const PatchTree tree = test::front_tree(test::office(), 1);
    EXPECT_NE(tree.lookup(0, false, vec3(1, 1, 0)), kNone);
    EXPECT_EQ(tree.lookup(0, true, vec3(1, 1, 0)), kNone);
}

TEST(PatchTree, PatchPointsCoverAPatchByArea) {
    const Made made(1);
    const PatchTree& t = made.tree;
    for (const NodeId leaf : {t.leaves.front(), t.leaves[t.leaves.size() / 2], t.leaves.back()}) {
        vec3 mean(0);
        constexpr int kPoints = 4096;
        for (std::uint32_t i = 0; i < kPoints; ++i)
            mean += t.patch_point(leaf, r2_sample(i, 1)) / static_cast<float>(kPoints);
        // The mean of uniform points is the centroid; a trapezium's differs a little from the mean
        // of its corners.
        EXPECT_LT(glm::distance(mean, t.center[at(leaf)]), 0.05F * t.radius[at(leaf)]);
    }
}

TEST(GrowingTree, SquaresSplitInFourAndStripsInTwo) {
    const auto children = [](const vec3& a, const vec3& b, bool triangle) {
        Surface s;
        s.corner_count = triangle ? 3 : 4;
        s.corners = {vec3(0), a, triangle ? b : a + b, b};
        GrowingTree tree({s});
        tree.split(1);  // below the root cluster
        return tree.node(1).child_count;
    };
    EXPECT_EQ(children({1, 0, 0}, {0, 1, 0}, false), 4);
    EXPECT_EQ(children({1.5F, 0, 0}, {0, 1, 0}, false), 4);
    EXPECT_EQ(children({1.7F, 0, 0}, {0, 1, 0}, false), 2);
    EXPECT_EQ(children({1, 0, 0}, {0, 9, 0}, false), 2);
    EXPECT_EQ(children({1, 0, 0}, {0, 1, 0}, true), 4);
    EXPECT_EQ(children({5, 0, 0}, {0, 1, 0}, true), 2);
}

TEST(GrowingTree, StripsEndAsNearlySquarePatches) {
    Surface s;
    s.corner_count = 4;
    s.corners = {vec3(0), vec3(8, 0, 0), vec3(8, 0.3F, 0), vec3(0, 0.3F, 0)};
    GrowingTree tree({s});
    tree.split_to(0.5F);
    for (NodeId n = 0; n < static_cast<NodeId>(tree.size()); ++n) {
        const GrowingNode& node = tree.node(n);
        if (!node.is_leaf()) continue;
        EXPECT_LT(glm::distance(node.corners[0], node.corners[1]),
                  2 * GrowingTree::kElongated * glm::distance(node.corners[1], node.corners[2]));
    }
}

TEST(GrowingTree, EstimateIsNearTheTruth) {
    const Scene scene = scene_of_all_shapes();
    const std::vector<Surface> surfaces = test::front_surfaces(scene);
    for (const float max_edge : {1.0F, 0.3F, 0.07F}) {
        const GrowingTree::Estimate estimate = GrowingTree::estimate_patches(surfaces, max_edge);
        GrowingTree tree(surfaces);
        tree.split_to(max_edge);
        double patches = 0;
        for (NodeId n = 0; n < static_cast<NodeId>(tree.size()); ++n)
            patches += tree.node(n).is_cluster() ? 0 : 1;
        // Each side is halved a whole number of times, as if it were alone.
        EXPECT_LT(estimate.patches, 2 * patches) << max_edge;
        EXPECT_GT(estimate.patches, 0.5 * patches) << max_edge;
        EXPECT_EQ(scene.objects[at(estimate.largest_object)].name, "Room");
        EXPECT_GT(estimate.largest_object_patches, 0.4 * estimate.patches);
    }
}

TEST(PushPull, KeepsTheMeanAndAddsAncestors) {
    const Made made(0.5F);
    const PatchTree& t = made.tree;
    std::vector<float> values(t.size(), 99);
    double sum = 0;
    for (const NodeId leaf : t.leaves) {
        values[at(leaf)] = to_unit_float(hash_u32(static_cast<std::uint32_t>(leaf)));
        sum += static_cast<double>(values[at(leaf)]) * t.area[at(leaf)];
    }
    pull_area_average<float>(t, values);
    EXPECT_NEAR(values[0], sum / t.area[0], 1e-3);

    std::vector<int> depth(t.size(), 1);
    push_sum<int>(t, depth);
    for (NodeId n = 0; n < static_cast<NodeId>(t.size()); ++n)
        ASSERT_EQ(depth[at(n)], t.is_leaf(n) ? t.depth[at(n)] + 1 : 0);
}

TEST(PatchTree, MaterialsAreAveragedOverTexturedPatches) {
    Scene scene;
    const int m = test::add_material(scene, vec3(0.5F), vec3(2));
    Texture checker;  // left half black, right half white
    checker.width = 64;
    checker.height = 1;
    for (int x = 0; x < 64; ++x)
        checker.pixels.emplace_back(vec3(x < 32 ? 0.0F : 1.0F), 1);
    scene.textures.push_back(checker);
    scene.materials[at(m)].albedo_texture = 0;
    test::add_quad(scene, "Quad", vec3(0), vec3(2, 0, 0), vec3(0, 1, 0), m);
    const PatchTree t = test::front_tree(scene, 0.5F);
    const PatchMaterials materials = average_materials(scene, t);
    for (const NodeId leaf : t.leaves) {
        EXPECT_NEAR(materials.albedo[at(leaf)].x, t.center[at(leaf)].x < 1 ? 0.0F : 0.5F, 0.05F);
        EXPECT_EQ(materials.emission[at(leaf)].x, 2);
    }
    EXPECT_NEAR(materials.albedo[at(t.surface_node[0])].x, 0.25F, 0.01F);
}

}  // namespace
}  // namespace antiradiance
