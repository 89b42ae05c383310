// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "inspect/patch_links.h"
#include "inspect/solved.h"
#include "links/visibility.h"

namespace antiradiance {
namespace {

using test::Plates;

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

// The kinds of the links from one patch to another.
std::vector<LinkKind> kinds(const Plates& plates, NodeId source, NodeId receiver) {
    std::vector<LinkKind> found;
    for (const PatchLink& l : links_of(plates.solved, receiver, kAll).links) {
        if (l.source == source && l.receiver == receiver) found.push_back(l.kind);
    }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

// Mückl & Dachsbacher, Fig. 2.
TEST(LinksOf, ThePapersFigureHasAllThreeKinds) {
    const Plates plates(0);
    const NodeId light = plates.leaf(Plates::kLight, -1);
    const NodeId middle = plates.leaf(Plates::kMiddle, 1);
    const NodeId lowest = plates.leaf(Plates::kLowest, 1);
    ASSERT_NE(light, kNone);
    EXPECT_EQ(kinds(plates, light, middle), std::vector{LinkKind::kNeeded});
    EXPECT_EQ(kinds(plates, light, lowest), std::vector{LinkKind::kOccluded});
    EXPECT_EQ(kinds(plates, middle, lowest), std::vector{LinkKind::kAntiradiance});
}

TEST(LinksOf, ALinkThatIsPartlyFreeIsNeeded) {
    const Plates half(1);  // it hides the centres from each other
    EXPECT_EQ(kinds(half, half.leaf(Plates::kLight, -1), half.leaf(Plates::kLowest, 1)),
              std::vector{LinkKind::kNeeded});
}

// Against all segments of the leaf's ancestors, one after the other.
TEST(LinksOf, ALeafAreThoseOfAllItsAncestors) {
    const SolvedScene& solved = test::solved_office(Visibility::kImplicit);
    const PatchTree& tree = solved.model->tree;
    const LinkSet& links = solved.links();
    std::size_t above = 0;
    for (std::size_t i = 0; i < tree.leaves.size(); i += 37) {
        const NodeId leaf = tree.leaves[i];
        std::size_t count = 0;
        for (NodeId node = leaf; node != kNone;
             node = tree.parent[static_cast<std::size_t>(node)]) {
            for (const Segment& s : links.segments)
                count += s.receiver == node ? s.end - s.begin : 0;
        }
        const PatchLinks found = links_of(solved, leaf, kAll);
        EXPECT_EQ(found.total, count);
        EXPECT_EQ(found.links.size(), count);
        above += static_cast<std::size_t>(std::ranges::count_if(
            found.links, [&](const PatchLink& l) { return l.receiver != leaf; }));
        for (const PatchLink& l : found.links) {
            EXPECT_EQ(l.kind == LinkKind::kAntiradiance, l.form_factor < 0);
            EXPECT_TRUE(l.bin >= 0 && l.bin < links.bins.count());
        }
    }
    EXPECT_GT(above, 0U) << "a scene without links of ancestors tests nothing";
}

TEST(LinksOf, ALimitKeepsThoseOfLargestTransfer) {
    const SolvedScene& solved = test::solved_office(Visibility::kImplicit);
    const PatchTree& tree = solved.model->tree;
    const NodeId leaf = tree.leaves[tree.leaves.size() / 2];
    const PatchLinks all = links_of(solved, leaf, kAll);
    const PatchLinks some = links_of(solved, leaf, 20);
    EXPECT_EQ(some.total, all.total);
    ASSERT_EQ(some.links.size(), 20U);
    ASSERT_GT(all.total, 40U);
    const auto transfer = [&](const PatchLink& l) {
        return link_transfer(tree, l.source, leaf, l.form_factor);
    };
    EXPECT_TRUE(std::ranges::is_sorted(all.links, std::ranges::greater{}, transfer));
    for (std::size_t i = 0; i < some.links.size(); ++i) {
        EXPECT_EQ(some.links[i].source, all.links[i].source);
        EXPECT_EQ(some.links[i].kind, all.links[i].kind) << "the limit changes no kind";
    }
}

// Rays have tested them: none is occluded, and none carries antiradiance.
TEST(LinksOf, ExplicitVisibilityAreNeeded) {
    const SolvedScene& solved = test::solved_office(Visibility::kExplicit);
    const std::vector<NodeId>& leaves = solved.model->tree.leaves;
    std::size_t count = 0;
    std::size_t needed = 0;
    for (std::size_t i = 0; i < leaves.size(); i += 17) {
        for (const PatchLink& l : links_of(solved, leaves[i], kAll).links) {
            EXPECT_NE(l.kind, LinkKind::kAntiradiance);
            ++count;
            needed += l.kind == LinkKind::kNeeded ? 1 : 0;
        }
    }
    ASSERT_GT(count, 100U);
    EXPECT_EQ(needed, count);
}

TEST(LinkKinds, HaveNamesInTheirOrder) {
    ASSERT_EQ(link_kinds().size(), 3U);
    EXPECT_EQ(link_kinds()[static_cast<std::size_t>(LinkKind::kOccluded)].id, "OCCLUDED");
    EXPECT_EQ(link_kinds()[static_cast<std::size_t>(LinkKind::kAntiradiance)].id, "ANTIRADIANCE");
}

TEST(Pick, FindsTheLeafAndTheSideThatTheRayMeets) {
    const Plates plates(1);
    const vec3 above(2, 1, 1.5F);
    const vec3 below(2, 1, 0.5F);
    EXPECT_EQ(pick(plates.solved, above, {0, 0, -3}), plates.leaf(Plates::kMiddle, 1));
    EXPECT_EQ(pick(plates.solved, below, {0, 0, 3}), plates.leaf(Plates::kMiddle, -1));
    EXPECT_NE(plates.leaf(Plates::kMiddle, -1), kNone) << "one side alone tells no sides apart";
}

TEST(Pick, FindsThePatchAroundThePoint) {
    const SolvedScene& solved = test::solved_office(Visibility::kExplicit);
    const PatchTree& tree = solved.model->tree;
    const vec3 from(0.3F, 0.4F, 2);
    for (const vec3& floor : {vec3(0.3F, 0.2F, 0), vec3(3, 0.3F, 0), vec3(5.7F, 3.6F, 0)}) {
        const NodeId leaf = pick(solved, from, floor - from);
        ASSERT_NE(leaf, kNone);
        const auto n = static_cast<std::size_t>(leaf);
        EXPECT_GT(tree.normal[n].z, 0.99F);
        EXPECT_LE(glm::distance(tree.center[n], floor), tree.radius[n]);
    }
}

TEST(Pick, FindsNothingWhereTheRayLeavesTheScene) {
    EXPECT_EQ(pick(Plates(0).solved, {1, 1, 5}, {0, 0, 1}), kNone);
}

}  // namespace
}  // namespace antiradiance
