// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's figures as scenes of a few quads.
#include <gtest/gtest.h>

#include "hand_made_links.h"

namespace antiradiance {
namespace {

using test::HandMadeLinks;
using test::holds_minus;
using test::holds_plus;

constexpr PruneOptions kHeuristic2{.method = PruneMethod::kHeuristic2};
constexpr PruneOptions kShaftsAndAlgorithm3{.method = PruneMethod::kConservative,
                                            .conservative_keeps = ConservativeKeeps::kAlgorithm3};
constexpr PruneOptions kOracle2{.method = PruneMethod::kOracle2};

LinkVisibility visibility_of(const HandMadeLinks& made, NodeId source, NodeId receiver,
                             Shaft shaft) {
    Progress progress;
    const LinkSet links = made.links();
    const Blockers blockers(made.scene, made.tree);
    const auto visibility = classify_links(made.tree, links, blockers, {.shaft = shaft}, progress);
    for (const Segment& s : links.segments) {
        for (LinkId l = s.begin; l < s.end; ++l) {
            if (s.receiver == receiver && links.links[l].source == source) return visibility[l];
        }
    }
    ADD_FAILURE() << "no link";
    return LinkVisibility::kFull;
}

// Fig. 2: a sender above n slabs of its size; all links that antiradiance needs.
constexpr int kSlabs = 4;
struct Stack : HandMadeLinks {
    Stack() {
        add("S", 0.2F * (kSlabs + 1), vec2(0), vec2(1), true);
        for (int i = 1; i <= kSlabs; ++i)  // downwards
            add(std::to_string(i), 0.2F * static_cast<float>(kSlabs + 1 - i), vec2(0), vec2(1),
                false);
        make_tree();
        for (int i = 1; i <= kSlabs; ++i) {
            plus(node("S"), slab(i));
            for (int k = i + 1; k <= kSlabs; ++k)
                minus(slab(i), slab(k));
        }
    }
    [[nodiscard]] NodeId slab(int i) const { return node(std::to_string(i)); }
};

TEST(Heuristic1, OfAStackOnlyTheFirstLinkIsLeft) {
    const Stack stack;
    const LinkSet left = stack.pruned(PruneMethod::kHeuristic1);
    ASSERT_EQ(left.links.size(), 1U);
    EXPECT_TRUE(holds_plus(left, stack.node("S"), stack.slab(1)));
}

TEST(Heuristic2, OfAStackTheShortestLinksAreLeft) {
    // Rule 2 keeps the shortest link of every receiver; those between slabs carry nothing any more.
    const Stack stack;
    for (const PruneOptions& options : {kHeuristic2, kShaftsAndAlgorithm3}) {
        const LinkSet left = stack.pruned(options);
        EXPECT_EQ(left.links.size(), static_cast<std::size_t>(kSlabs));
        EXPECT_EQ(left.radiance_count, 1U);
        EXPECT_TRUE(holds_plus(left, stack.node("S"), stack.slab(1)));
        for (int i = 1; i < kSlabs; ++i)
            EXPECT_TRUE(holds_minus(left, stack.slab(i), stack.slab(i + 1))) << i;
    }
}

TEST(Oracle1, FindsTheStackAsWell) {
    const Stack stack;
    EXPECT_EQ(stack.pruned(PruneMethod::kOracle1).links.size(), 1U);
}

TEST(Oracle2, FindsTheStackAsWell) {
    const Stack stack;
    const LinkSet left = stack.pruned(PruneMethod::kOracle2);
    EXPECT_EQ(left.links.size(), static_cast<std::size_t>(kSlabs));
    EXPECT_EQ(left.radiance_count, 1U);
}

// Fig. 4: a sender of 1 m above its like, and an occluder half way.
struct Between : HandMadeLinks {
    Between(const vec2& low, const vec2& high, float half_way = 1) {
        add("S", 2 * half_way, vec2(-0.5F), vec2(0.5F), true);
        add("O", half_way, low, high, false);
        add("R", 0, vec2(-0.5F), vec2(0.5F), false);
        make_tree();
        plus(node("S"), node("R"));
        plus(node("S"), node("O"));
        minus(node("O"), node("R"));
    }
    [[nodiscard]] LinkVisibility visibility(Shaft shaft) const {
        return visibility_of(*this, node("S"), node("R"), shaft);
    }
};

TEST(ClassifyLinks, FullPartialAndNone) {
    // From R's centre S covers a square of .5 m at half way, from its corners one of 1 m.
    const Between all(vec2(-0.51F), vec2(0.51F));
    const Between middle(vec2(-0.26F), vec2(0.26F));
    const Between half(vec2(-0.5F), vec2(0, 0.5F), 10);  // so far off that it lies in S's direction
    EXPECT_EQ(all.visibility(Shaft::kFromCenter), LinkVisibility::kNone);
    EXPECT_EQ(all.visibility(Shaft::kFromCorners), LinkVisibility::kNone);
    EXPECT_EQ(middle.visibility(Shaft::kFromCenter), LinkVisibility::kNone);
    EXPECT_EQ(middle.visibility(Shaft::kFromCorners), LinkVisibility::kPartial);
    EXPECT_EQ(half.visibility(Shaft::kFromCenter), LinkVisibility::kPartial);

    Between open(vec2(-0.51F), vec2(0.51F));
    open.raw.resize(1);  // S -> R alone: nothing tells of O
    EXPECT_EQ(open.visibility(Shaft::kFromCorners), LinkVisibility::kFull);
}

TEST(ClassifyLinks, WhatLiesBeyondTheSenderBlocksNothing) {
    HandMadeLinks made;
    made.add("S", 1, vec2(-0.1F), vec2(0.1F), true);
    made.add("O", 2, vec2(-3), vec2(3), true);
    made.add("R", 0, vec2(-0.1F), vec2(0.1F), false);
    made.make_tree();
    made.plus(made.node("S"), made.node("R"));
    made.plus(made.node("O"), made.node("R"));
    EXPECT_EQ(visibility_of(made, made.node("S"), made.node("R"), Shaft::kFromCorners),
              LinkVisibility::kPartial);
}

// Two senders side by side, each hidden from two receivers side by side by an occluder of its own
// and by no other.
struct Pairs : HandMadeLinks {
    Pairs() {
        add("S1", 20, {-1, -0.5F}, {-0.02F, 0.5F}, true);
        add("S2", 20, {0.02F, -0.5F}, {1, 0.5F}, true);
        add("O1", 10, {-0.65F, -0.6F}, {0.15F, 0.6F}, false);
        add("O2", 10.5F, {-0.15F, -0.6F}, {0.7F, 0.6F}, false);
        add("R1", 0, {-0.2F, -0.2F}, {-0.01F, 0.2F}, false);
        add("R2", 0, {0.01F, -0.2F}, {0.2F, 0.2F}, false);
        make_tree();
    }
    // Of a + link from source to receiver, where - links of the occluders end at `at`.
    [[nodiscard]] LinkVisibility visibility(NodeId source, const std::vector<NodeId>& occluders,
                                            NodeId receiver, NodeId at) {
        raw.clear();
        plus(source, receiver);
        for (const NodeId o : occluders) {
            EXPECT_EQ(bin(o, at), bin(source, receiver));
            minus(o, at);
        }
        return visibility_of(*this, source, receiver, Shaft::kFromCorners);
    }
    [[nodiscard]] LinkVisibility visibility(NodeId source, const std::vector<NodeId>& occluders,
                                            NodeId receiver) {
        return visibility(source, occluders, receiver, receiver);
    }
};

TEST(ClassifyLinks, EverySurfaceOfASenderClusterMustBeBlocked) {
    Pairs made;
    const NodeId both = made.cluster("S1", "S2");
    const NodeId o1 = made.node("O1");
    const NodeId o2 = made.node("O2");
    const NodeId r = made.node("R1");
    ASSERT_EQ(made.visibility(made.node("S1"), {o1}, r), LinkVisibility::kNone);
    ASSERT_EQ(made.visibility(made.node("S2"), {o2}, r), LinkVisibility::kNone);
    ASSERT_EQ(made.visibility(made.node("S1"), {o2}, r), LinkVisibility::kPartial);
    ASSERT_EQ(made.visibility(made.node("S2"), {o1}, r), LinkVisibility::kPartial);
    EXPECT_EQ(made.visibility(both, {o1}, r), LinkVisibility::kPartial);
    EXPECT_EQ(made.visibility(both, {o2}, r), LinkVisibility::kPartial);
    EXPECT_EQ(made.visibility(both, {o1, o2}, r), LinkVisibility::kNone);
}

TEST(ClassifyLinks, EachSurfaceOfAnOccluderClusterMayBlock) {
    Pairs made;
    const NodeId occluders = made.cluster("O1", "O2");
    const NodeId r = made.node("R1");
    EXPECT_EQ(made.visibility(made.node("S1"), {occluders}, r), LinkVisibility::kNone);
    EXPECT_EQ(made.visibility(made.node("S2"), {occluders}, r), LinkVisibility::kNone);
    EXPECT_EQ(made.visibility(made.cluster("S1", "S2"), {occluders}, r), LinkVisibility::kNone);
}

TEST(ClassifyLinks, EverySurfaceOfAReceiverClusterMustBeBlocked) {
    Pairs made;
    const NodeId s = made.node("S1");
    const NodeId o1 = made.node("O1");
    const NodeId both = made.cluster("R1", "R2");
    EXPECT_EQ(made.visibility(s, {o1}, both), LinkVisibility::kNone);
    // Their links count for each other.
    EXPECT_EQ(made.visibility(s, {o1}, both, made.node("R1")), LinkVisibility::kNone);
    EXPECT_EQ(made.visibility(s, {o1}, made.node("R1"), both), LinkVisibility::kNone);

    Pairs narrow;
    narrow.scene = {};
    test::add_material(narrow.scene, vec3(0.5F));
    narrow.add("S1", 20, {-1, -0.5F}, {-0.02F, 0.5F}, true);
    narrow.add("O1", 10, {-0.65F, -0.6F}, {0.02F, 0.6F}, false);
    narrow.add("R1", 0, {-0.2F, -0.2F}, {-0.01F, 0.2F}, false);
    narrow.add("R2", 0, {0.01F, -0.2F}, {0.2F, 0.2F}, false);
    narrow.make_tree();
    const NodeId o = narrow.node("O1");
    ASSERT_EQ(narrow.visibility(narrow.node("S1"), {o}, narrow.node("R1")), LinkVisibility::kNone);
    EXPECT_EQ(narrow.visibility(narrow.node("S1"), {o}, narrow.cluster("R1", "R2")),
              LinkVisibility::kPartial);
}

TEST(Heuristic1, TheOccluderMustFillTheDirection) {
    // Fig. 5, left and centre: 128 bins are .1 sr each, a disk of .36 m at 1 m.
    const Between large(vec2(-0.5F), vec2(0.5F));
    EXPECT_FALSE(
        holds_plus(large.pruned(PruneMethod::kHeuristic1), large.node("S"), large.node("R")));
    const Between small(vec2(-0.1F), vec2(0.1F));
    EXPECT_EQ(small.pruned(PruneMethod::kHeuristic1).links.size(), 3U);
}

// Fig. 5, right, and Fig. 6 a-c: links end at a small part of a large surface.
struct SmallPart : HandMadeLinks {
    SmallPart() {
        add("S", 3, vec2(-0.5F), vec2(0.5F), true);
        add("O", 1, vec2(-1), vec2(1), false);
        add("R", 0, vec2(-0.2F), vec2(0.2F), false);
        make_tree(1.01F);
        part = leaf("O", {0.01F, 0.01F, 1});
        plus(node("S"), node("R"));
        plus(node("S"), part);
    }
    NodeId part = kNone;
};

TEST(Heuristic1, ThePatchAboveCounts) {
    SmallPart made;
    made.minus(made.tree.parent[static_cast<std::size_t>(made.part)], made.node("R"));
    ASSERT_NE(made.part, made.node("O"));
    ASSERT_EQ(made.bin(made.node("S"), made.node("R")), made.bin(made.node("O"), made.node("R")));
    // S -> part lies in a direction of its own: the strict reading does not see it.
    ASSERT_NE(made.bin(made.node("S"), made.part), made.bin(made.node("S"), made.node("R")));
    EXPECT_EQ(made.pruned(PruneMethod::kHeuristic1).links.size(), 3U);
    const LinkSet left = made.pruned(
        PruneOptions{.method = PruneMethod::kHeuristic1, .directions = PruneDirections::kText});
    ASSERT_EQ(left.links.size(), 1U);
    EXPECT_TRUE(holds_plus(left, made.node("S"), made.part));
}

TEST(Heuristic2, TheSurfaceOfThePatchCounts) {
    SmallPart made;
    // From R's centre the part lies in S's direction, but hides less than a quarter of it.
    const NodeId part = made.part;
    made.raw.push_back({made.node("R"), part, -0.01F,
                        static_cast<std::uint16_t>(made.bin(made.node("S"), made.node("R")))});
    for (const PruneOptions& options : {kHeuristic2, kShaftsAndAlgorithm3})
        EXPECT_FALSE(holds_plus(made.pruned(options), made.node("S"), made.node("R")));
}

TEST(Heuristic2, LinksToPatchesAboveAndBelowTheReceiverAreEvidence) {
    for (const bool above : {true, false}) {
        HandMadeLinks made;
        made.add("S", 20, vec2(-0.5F), vec2(0.5F), true);
        made.add("O", 10, vec2(-2), vec2(2), false);
        made.add("R", 0, vec2(-1), vec2(1), false);
        made.make_tree(1.01F);
        const NodeId whole = made.node("R");
        const NodeId child = whole + 1;
        ASSERT_EQ(made.bin(made.node("S"), whole), made.bin(made.node("S"), child));
        made.plus(made.node("S"), above ? child : whole);
        made.minus(made.node("O"), above ? whole : child);
        ASSERT_EQ(made.links().bin_segments.back(), 2U);
        const LinkSet left = made.pruned(kShaftsAndAlgorithm3);
        EXPECT_EQ(left.radiance_count, 0U) << above;
        EXPECT_EQ(left.antiradiance_count, 1U) << above;
    }
}

// Fig. 6 d, flat enough for all links to share a direction: O1 hides O, and both hide parts of S
// from R.
struct PartlyHidden : HandMadeLinks {
    PartlyHidden() {
        add("S", 30, {0, -1}, {2, 1}, true);
        add("O", 20, {0, -1}, {0.5F, 1}, false);
        add("O1", 10, {0, -1}, {0.6F, 1}, false);
        add("R", 0, {0, -0.5F}, {0.3F, 0.5F}, false);
        make_tree();
        for (const char* receiver : {"O", "O1", "R"})
            plus(node("S"), node(receiver));
        minus(node("O"), node("O1"));
        minus(node("O"), node("R"));
        minus(node("O1"), node("R"));
    }
};

TEST(Heuristic2, AntiradianceOfAPartialOcclusionStays) {
    const PartlyHidden made;
    ASSERT_EQ(made.bin(made.node("S"), made.node("R")), made.bin(made.node("O"), made.node("R")));
    for (const Shaft shaft : {Shaft::kFromCenter, Shaft::kFromCorners}) {
        EXPECT_EQ(visibility_of(made, made.node("O"), made.node("R"), shaft),
                  LinkVisibility::kNone);
        EXPECT_EQ(visibility_of(made, made.node("S"), made.node("R"), shaft),
                  LinkVisibility::kPartial);
    }
    for (const PruneOptions& options : {kHeuristic2, kShaftsAndAlgorithm3, kOracle2}) {
        const LinkSet left = made.pruned(options);
        EXPECT_EQ(left.links.size(), made.raw.size());
        EXPECT_TRUE(holds_minus(left, made.node("O"), made.node("R")));
    }
}

TEST(Heuristic2, WithoutThatPartialOcclusionItGoes) {
    PartlyHidden made;
    made.raw.erase(made.raw.begin() + 2);  // S -> R
    for (const PruneOptions& options : {kHeuristic2, kShaftsAndAlgorithm3})
        EXPECT_FALSE(holds_minus(made.pruned(options), made.node("O"), made.node("R")));
    PartlyHidden unlit;
    unlit.raw.erase(unlit.raw.begin());  // S -> O
    EXPECT_FALSE(
        holds_minus(unlit.pruned(PruneMethod::kHeuristic2), unlit.node("O"), unlit.node("R")));
}

TEST(BlockingSides, OfASlabsAntiradianceOnlyFacingOnesCount) {
    // Light from S falls on the slab's top; its antiradiance leaves through the bottom, which sends
    // light to R of its own.
    HandMadeLinks made;
    made.add("S", 3, vec2(-1), vec2(1), true);
    made.add("Top", 2, vec2(-1), vec2(1), false);
    made.add("Bottom", 1.9F, vec2(-1), vec2(1), true);
    made.add("R", 0, vec2(-0.2F), vec2(0.2F), false);
    made.make_tree();
    made.plus(made.node("S"), made.node("Top"));
    made.plus(made.node("S"), made.node("R"));
    made.minus(made.node("Top"), made.node("R"));
    made.plus(made.node("Bottom"), made.node("R"));
    for (PruneOptions options : {kHeuristic2, kShaftsAndAlgorithm3, kOracle2}) {
        EXPECT_EQ(made.pruned(options).antiradiance_count, 0U);
        options.blocking_sides = BlockingSides::kFacing;
        const LinkSet left = made.pruned(options);
        EXPECT_EQ(left.antiradiance_count, 1U);
        EXPECT_FALSE(holds_plus(left, made.node("S"), made.node("R")));
    }
}

TEST(Heuristic2Then1, RemovesWhatBothFind) {
    const Between large(vec2(-0.5F), vec2(0.5F));
    // 2 removes S -> R only: the occluder's own link is the shortest. 1 then has no triple left.
    EXPECT_EQ(large.pruned(PruneMethod::kHeuristic2Then1).links.size(), 2U);
    const Between bar(vec2(-0.2F, -2), vec2(0.2F, 2));
    // 2 sees that parts of S are free beside it; 1 goes by the solid angle.
    EXPECT_EQ(bar.pruned(PruneMethod::kHeuristic2).links.size(), 3U);
    EXPECT_EQ(bar.pruned(PruneMethod::kHeuristic1).links.size(), 1U);
    EXPECT_EQ(bar.pruned(PruneMethod::kHeuristic2Then1).links.size(), 1U);
}

}  // namespace
}  // namespace antiradiance
