// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/refine.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "base/error.h"
#include "hierarchy/push_pull.h"
#include "support/linked_scene.h"
#include "support/scene_builder.h"

namespace antiradiance {
namespace {

using test::LinkedScene;

Scene room() {
    Scene scene;
    test::add_box(scene, "Room", vec3(0), vec3(2, 1.5F, 1), test::add_material(scene, vec3(0.5F)),
                  test::Facing::kInward);
    return scene;
}

// With a block, a slanted triangle and a sheet: + and - links, edges that touch, planes that cut.
Scene furnished_room() {
    Scene scene = room();
    test::add_box(scene, "Block", vec3(0.4F, 0.5F, 0.2F), vec3(0.8F, 0.9F, 0.7F), 0);
    test::add_polygon(scene, "Ramp", {{1.2F, 0.2F, 0}, {1.9F, 0.3F, 0.1F}, {1.5F, 1.1F, 0.6F}}, 0);
    test::add_quad(scene, "Sheet", vec3(1.1F, 0.6F, 0.5F), vec3(0, 0.7F, 0), vec3(0, 0, 0.4F), 0);
    return scene;
}

RefineOptions coarse() {
    RefineOptions options;
    options.link_threshold = 0.05F;
    options.bin_share = 4;
    options.least_edge = 0.25F;
    return options;
}

// Heights of a patch's corners over another's plane.
struct Heights {
    float low = 1e9F, high = -1e9F;
    [[nodiscard]] bool in_front() const { return low > kPlane; }
    [[nodiscard]] bool behind() const { return high < -kPlane; }
    [[nodiscard]] bool cut() const { return low < -kPlane && high > kPlane; }
    static constexpr float kPlane = 1e-3F;  // m: lies in the plane
};
Heights heights(const PatchTree& tree, NodeId patch, NodeId plane) {
    const auto corners = tree.patch_corners(patch);
    Heights h;
    for (int i = 0; i < tree.corner_count(patch); ++i) {
        const float height = glm::dot(
            corners[static_cast<std::size_t>(i)] - tree.center[static_cast<std::size_t>(plane)],
            tree.normal[static_cast<std::size_t>(plane)]);
        h.low = std::min(h.low, height);
        h.high = std::max(h.high, height);
    }
    return h;
}

// The links at or above a pair of leaves.
struct Links {
    int plus = 0, minus = 0;
    bool cut = false;  // an end of one crosses the plane of the other
};
class PairLinks {
public:
    explicit PairLinks(const LinkedScene& scene) : tree_(scene.tree) {
        for (const RawLink& l : scene.refined.links)
            links_.insert({l.source, l.receiver, l.form_factor < 0});
    }
    [[nodiscard]] Links operator()(NodeId source, NodeId receiver) const {
        Links found;
        for (NodeId s = source; s != kNone; s = tree_.parent[static_cast<std::size_t>(s)]) {
            for (NodeId r = receiver; r != kNone; r = tree_.parent[static_cast<std::size_t>(r)]) {
                const auto plus = static_cast<int>(links_.count({s, r, false}));
                const auto minus = static_cast<int>(links_.count({s, r, true}));
                found.plus += plus;
                found.minus += minus;
                if (plus + minus > 0)
                    found.cut = heights(tree_, s, r).cut() || heights(tree_, r, s).cut();
            }
        }
        return found;
    }

private:
    const PatchTree& tree_;
    std::set<std::tuple<NodeId, NodeId, bool>> links_;
};

TEST(Refine, EveryPairOfLeavesIsLinkedOnceBySide) {
    for (const bool antiradiance : {true, false}) {
        RefineOptions options = coarse();
        options.antiradiance = antiradiance;
        const LinkedScene scene(furnished_room(), 0.8F, options);
        const PatchTree& tree = scene.tree;
        const PairLinks links(scene);
        std::size_t front = 0, behind = 0, cut = 0;
        for (const NodeId s : tree.leaves) {
            for (const NodeId r : tree.leaves) {
                const Links l = links(s, r);
                const Heights source = heights(tree, s, r);
                const Heights receiver = heights(tree, r, s);
                SCOPED_TRACE(testing::Message() << s << " -> " << r);
                ASSERT_LE(l.plus, 1);
                ASSERT_LE(l.minus, 1);
                if (l.cut) {
                    ++cut;
                    continue;  // form factors end at the planes by themselves
                }
                if (source.behind()) {
                    ASSERT_EQ(l.plus + l.minus, 0) << "light reaches fronts only";
                } else if (source.in_front() && receiver.in_front()) {
                    ASSERT_EQ(l.plus, 1);
                    ASSERT_EQ(l.minus, 0);
                    ++front;
                } else if (source.in_front() && receiver.behind()) {
                    ASSERT_EQ(l.plus, 0);
                    ASSERT_EQ(l.minus, antiradiance ? 1 : 0);
                    ++behind;
                }
            }
        }
        EXPECT_GT(front, 10000U);
        EXPECT_GT(behind, 1000U);
        EXPECT_LT(cut, front / 4);
    }
}

float longest_edge(const PatchTree& tree, NodeId n) {
    const auto c = tree.patch_corners(n);
    const int count = tree.corner_count(n);
    float longest = 0;
    for (int i = 0; i < count; ++i) {
        longest = std::max(longest, glm::distance(c[static_cast<std::size_t>(i)],
                                                  c[static_cast<std::size_t>((i + 1) % count)]));
    }
    return longest;
}

TEST(Refine, LinksObeyTheOracle) {
    RefineOptions options;
    options.link_threshold = 0.02F;
    options.least_edge = 0.02F;
    options.receiver_levels = 0;
    const LinkedScene scene(furnished_room(), 0.8F, options, 64);
    const PatchTree& tree = scene.tree;
    float largest = 0;
    for (const RawLink& l : scene.refined.links) {
        const auto s = static_cast<std::size_t>(l.source);
        const auto r = static_cast<std::size_t>(l.receiver);
        const bool touching =
            glm::distance(tree.center[s], tree.center[r]) < tree.radius[s] + tree.radius[r];
        const bool final = longest_edge(tree, l.source) <= options.least_edge &&
                           longest_edge(tree, l.receiver) <= options.least_edge;
        if (!touching && !final) largest = std::max(largest, std::abs(l.form_factor));
    }
    // The oracle goes by the centres; close by, a whole receiver may see half as much again.
    EXPECT_LT(largest, 1.5F * options.link_threshold);
    EXPECT_GT(largest, 0.5F * options.link_threshold) << "finer than asked for";
}

TEST(Refine, SmallerThresholdMakesMoreLinksAndLeaves) {
    std::size_t links = 0, leaves = 0;
    for (const float eps : {0.1F, 0.03F, 0.01F}) {
        RefineOptions options = coarse();
        options.link_threshold = eps;
        options.least_edge = 0.05F;
        const LinkedScene scene(room(), 0.8F, options);
        EXPECT_GT(scene.refined.links.size(), links);
        EXPECT_GE(scene.tree.leaves.size(), leaves);
        links = scene.refined.links.size();
        leaves = scene.tree.leaves.size();
        for (const NodeId leaf : scene.tree.leaves) {  // no patch is cut below least_edge / 2
            const auto c = scene.tree.patch_corners(leaf);
            EXPECT_GT(glm::distance(c[0], c[1]), 0.49F * options.least_edge / 2);
        }
    }
}

TEST(Refine, DoesNotDependOnTheNumberOfThreads) {
    RefineOptions options = coarse();
    options.least_edge = 0.1F;
    const auto links = [&] {
        const LinkedScene scene(furnished_room(), 0.4F, options);
        std::vector<std::tuple<NodeId, NodeId, float, int>> all;
        for (const RawLink& l : scene.refined.links)
            all.emplace_back(l.receiver, l.source, l.form_factor, l.bin);
        return all;
    };
    const auto many = links();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(links(), many);
}

TEST(Refine, PairsHoldEveryPlusLinkOnce) {
    const LinkedScene scene(furnished_room(), 0.8F, coarse());
    const std::vector<RawLink>& links = scene.refined.links;
    std::vector<int> held(links.size(), 0);
    for (const LinkedPair& p : scene.refined.pairs) {
        EXPECT_GT(p.count, 0U);
        for (std::uint32_t i = p.first; i < p.first + p.count; ++i) {
            ++held[i];
            EXPECT_TRUE((links[i].source == p.a && links[i].receiver == p.b) ||
                        (links[i].source == p.b && links[i].receiver == p.a));
        }
    }
    for (std::size_t i = 0; i < links.size(); ++i)
        EXPECT_EQ(held[i], links[i].form_factor > 0 ? 1 : 0);
}

// Share of a leaf's hemisphere that links bring light from.
std::map<NodeId, double> row_sums(const LinkedScene& scene) {
    std::vector<double> sum(scene.tree.size(), 0);
    for (const RawLink& l : scene.refined.links)
        sum[static_cast<std::size_t>(l.receiver)] += l.form_factor;
    push_sum<double>(scene.tree, sum);
    std::map<NodeId, double> rows;
    for (const NodeId leaf : scene.tree.leaves)
        rows[leaf] = sum[static_cast<std::size_t>(leaf)];
    return rows;
}

TEST(Refine, RowsOfAClosedRoomAddUpToOne) {
    RefineOptions options;
    options.least_edge = 0.1F;
    const LinkedScene scene(room(), 0.3F, options);
    double mean = 0, area = 0, least = 9, most = 0;
    for (const auto& [leaf, sum] : row_sums(scene)) {
        const double a = scene.tree.area[static_cast<std::size_t>(leaf)];
        mean += a * sum;
        area += a;
        least = std::min(least, sum);
        most = std::max(most, sum);
    }
    // Single rows differ, because what crosses a large link is alike for all leaves below it.
    EXPECT_NEAR(mean / area, 1, 0.001);
    EXPECT_GT(least, 0.8);
    EXPECT_LT(most, 1.2);
}

// Between surfaces: sum over links of receiver area times form factor, m2.
std::map<std::pair<SurfaceId, SurfaceId>, double> exchange(const LinkedScene& scene) {
    const PatchTree& tree = scene.tree;
    std::map<std::pair<SurfaceId, SurfaceId>, double> sum;
    for (const RawLink& l : scene.refined.links) {
        const auto r = static_cast<std::size_t>(l.receiver);
        sum[{tree.surface[static_cast<std::size_t>(l.source)], tree.surface[r]}] +=
            tree.area[r] * l.form_factor;
    }
    return sum;
}

TEST(Refine, ExchangeBetweenTheFacesOfACubeIsReciprocalAndKnown) {
    Scene cube;
    test::add_box(cube, "Cube", vec3(0), vec3(1), test::add_material(cube, vec3(0.5F)),
                  test::Facing::kInward);
    RefineOptions options;
    options.least_edge = 0.05F;
    const LinkedScene scene(cube, 0.2F, options);
    const auto between = exchange(scene);
    EXPECT_EQ(between.size(), 30U);
    double worst_opposite = 0, worst_adjacent = 0, worst_reciprocity = 0;
    for (const auto& [pair, m2] : between) {
        const auto normal = [&](SurfaceId s) {
            return scene.tree.normal[static_cast<std::size_t>(
                scene.tree.surface_node[static_cast<std::size_t>(s)])];
        };
        const bool opposite = glm::dot(normal(pair.first), normal(pair.second)) < -0.5F;
        double& worst = opposite ? worst_opposite : worst_adjacent;
        worst = std::max(worst, std::abs(m2 / (opposite ? .199824896 : .200043776) - 1));
        worst_reciprocity =
            std::max(worst_reciprocity, std::abs(m2 / between.at({pair.second, pair.first}) - 1));
    }
    EXPECT_LT(worst_opposite, 0.001);
    EXPECT_LT(worst_adjacent, 0.001);
    EXPECT_LT(worst_reciprocity, 0.001);
}

TEST(Refine, TouchingPairsKeepTheirFormFactorInSeveralBins) {
    Scene corner;
    const int m = test::add_material(corner, vec3(0.5F));
    test::add_quad(corner, "Floor", vec3(0), vec3(1, 0, 0), vec3(0, 1, 0), m);
    test::add_quad(corner, "Wall", vec3(0), vec3(0, 1, 0), vec3(0, 0, 1), m);
    RefineOptions options = coarse();
    options.least_edge = 2;  // nothing can be split: one pair, touching
    options.receiver_levels = 0;
    const LinkedScene scene(corner, 2, options);
    std::map<NodeId, double> of_receiver;
    std::map<NodeId, std::set<int>> bins;
    for (const RawLink& l : scene.refined.links) {
        of_receiver[l.receiver] += l.form_factor;
        EXPECT_TRUE(bins[l.receiver].insert(l.bin).second) << "a bin twice";
    }
    ASSERT_EQ(of_receiver.size(), 2U);
    for (const auto& [receiver, ff] : of_receiver) {
        EXPECT_NEAR(ff, .200043776, 0.01);  // by 4 x 4 points of a square next to a wall
        EXPECT_GT(bins[receiver].size(), 5U);
    }
}

TEST(Refine, TooManyLinksAreRefusedWithAdvice) {
    RefineOptions options = coarse();
    options.most_links = 100;
    try {
        const LinkedScene scene(furnished_room(), 0.5F, options);
        FAIL() << scene.refined.links.size() << " links made";
    } catch (const SceneError& e) {
        EXPECT_NE(std::string(e.what()).find("Link Threshold"), std::string::npos) << e.what();
    }
}

TEST(Refine, ASingleSurfaceHasNoLinks) {
    Scene scene;
    test::add_quad(scene, "Floor", vec3(0), vec3(1, 0, 0), vec3(0, 1, 0),
                   test::add_material(scene, vec3(0.5F)));
    const LinkedScene linked(scene, 0.3F, coarse());
    EXPECT_TRUE(linked.refined.links.empty());
    EXPECT_GT(linked.tree.leaves.size(), 4U);
}

}  // namespace
}  // namespace antiradiance
