// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"
#include "hand_made_links.h"
#include "support/linked_scene.h"
#include "support/scenes.h"

namespace antiradiance {
namespace {

using test::holds_minus;
using test::holds_plus;

constexpr int kSlabs = 4;

// A sender above n solid slabs, with all links up and down.
struct SolidStack : test::HandMadeLinks {
    SolidStack() {
        add("S", 0.2F * kSlabs + 0.2F, vec2(0), vec2(1), true);
        for (int i = 0; i < kSlabs; ++i) {  // upwards
            add("bottom " + std::to_string(i), 0.2F * static_cast<float>(i), vec2(0), vec2(1),
                true);
            add("top " + std::to_string(i), 0.2F * static_cast<float>(i) + 0.05F, vec2(0), vec2(1),
                false);
        }
        make_tree();
        for (int i = 0; i < kSlabs; ++i) {
            plus(node("S"), top(i));
            plus(top(i), node("S"));
            minus(bottom(i), node("S"));
            for (int below = 0; below < i; ++below) {
                plus(bottom(i), top(below));
                plus(top(below), bottom(i));
                minus(top(i), top(below));
                minus(bottom(below), bottom(i));
            }
        }
    }
    [[nodiscard]] NodeId top(int i) const { return node("top " + std::to_string(i)); }
    [[nodiscard]] NodeId bottom(int i) const { return node("bottom " + std::to_string(i)); }
};

TEST(BalancedLinks, OfASolidStackOnlyWhatIsSeenIsLeft) {
    const SolidStack stack;
    const LinkSet left = stack.pruned(PruneMethod::kConservative);
    EXPECT_EQ(left.antiradiance_count, 0U);
    EXPECT_EQ(left.radiance_count, 2U * kSlabs) << "between neighbours, both ways";
    EXPECT_TRUE(holds_plus(left, stack.node("S"), stack.top(kSlabs - 1)));
    EXPECT_TRUE(holds_plus(left, stack.top(kSlabs - 1), stack.node("S")));
    for (int i = 1; i < kSlabs; ++i) {
        EXPECT_TRUE(holds_plus(left, stack.bottom(i), stack.top(i - 1)));
        EXPECT_TRUE(holds_plus(left, stack.top(i - 1), stack.bottom(i)));
    }
}

// Light from S falls on a slab's top; R lies below. Nothing hides the top from R but the bottom.
struct OneSlab : test::HandMadeLinks {
    explicit OneSlab(bool solid) {
        add("S", 3, vec2(-1), vec2(1), true);
        add("Top", 2, vec2(-1), vec2(1), false);
        if (solid) add("Bottom", 1.9F, vec2(-1), vec2(1), true);
        add("R", 0, vec2(-0.2F), vec2(0.2F), false);
        make_tree();
        plus(node("S"), node("Top"));
        plus(node("S"), node("R"));
        minus(node("Top"), node("R"));
        if (solid) plus(node("Bottom"), node("R"));
    }
};

TEST(BalancedLinks, LightStaysAsLongAsItsAntiradianceDoes) {
    const OneSlab solid(true);
    const LinkSet left = solid.pruned(PruneMethod::kConservative);
    EXPECT_EQ(left.links.size(), 2U);
    EXPECT_FALSE(holds_plus(left, solid.node("S"), solid.node("R")));
    EXPECT_FALSE(holds_minus(left, solid.node("Top"), solid.node("R")));

    const OneSlab sheet(false);  // S is hidden from R, but the sheet is not
    EXPECT_EQ(sheet.pruned(PruneMethod::kConservative).links.size(), 3U);
}

// Links removed when those between the given ends are blocked.
std::size_t removed_of(const OneSlab& slab, const std::vector<std::string>& blocked_to_r) {
    const LinkSet links = slab.links();
    std::vector<LinkVisibility> visibility(links.links.size(), LinkVisibility::kPartial);
    for (const Segment& s : links.segments) {
        for (LinkId l = s.begin; l < s.end; ++l) {
            for (const std::string& source : blocked_to_r) {
                if (s.receiver == slab.node("R") && links.links[l].source == slab.node(source))
                    visibility[l] = LinkVisibility::kNone;
            }
        }
    }
    Progress progress;
    const auto removed = blocked_and_balanced(slab.tree, links, visibility, progress);
    return static_cast<std::size_t>(std::count(removed.begin(), removed.end(), 1));
}

TEST(BalancedLinks, AntiradianceStaysAsLongAsItsLightDoes) {
    OneSlab slab(true);
    EXPECT_EQ(removed_of(slab, {"Top"}), 0U) << "S -> R is seen in part";
    EXPECT_EQ(removed_of(slab, {"S"}), 0U) << "Top would take back what is not sent";
    EXPECT_EQ(removed_of(slab, {"S", "Top"}), 2U);
    EXPECT_EQ(removed_of(slab, {"Bottom"}), 1U) << "light that no - link takes back";
    slab.raw.erase(slab.raw.begin());  // S -> Top
    EXPECT_EQ(removed_of(slab, {"Top"}), 1U) << "antiradiance of no light";
    EXPECT_EQ(removed_of(slab, {"S"}), 1U);
}

// The definition, link by link.
std::vector<std::uint8_t> reference(const PatchTree& tree, const LinkSet& links,
                                    const std::vector<LinkVisibility>& visibility) {
    struct One {
        NodeId source, receiver;
        bool plus;
        LinkId link;
    };
    const auto related = [&](NodeId a, NodeId b) {
        const auto holds = [&](NodeId upper, NodeId lower) {
            return upper <= lower && lower < tree.subtree_end[static_cast<std::size_t>(upper)];
        };
        return holds(a, b) || holds(b, a);
    };
    std::vector<std::uint8_t> removed(links.links.size(), 0);
    for (std::size_t b = 0; b + 1 < links.bin_segments.size(); ++b) {
        std::vector<One> all;
        for (SegmentId s = links.bin_segments[b]; s < links.bin_segments[b + 1]; ++s) {
            for (LinkId l = links.segments[s].begin; l < links.segments[s].end; ++l) {
                all.push_back({links.links[l].source, links.segments[s].receiver,
                               links.links[l].form_factor > 0, l});
                removed[l] = visibility[l] == LinkVisibility::kNone;
            }
        }
        const auto reaches = [&](NodeId s, NodeId x) {
            return std::any_of(all.begin(), all.end(), [&](const One& l) {
                return !removed[l.link] && l.plus && related(l.source, s) && related(l.receiver, x);
            });
        };
        const auto must_stay = [&](const One& link) {
            return std::any_of(all.begin(), all.end(), [&](const One& other) {
                if (removed[other.link] || other.plus == link.plus) return false;
                if (link.plus)
                    return related(other.receiver, link.receiver) &&
                           reaches(link.source, other.source);
                return related(other.receiver, link.source) && reaches(other.source, link.receiver);
            });
        };
        for (bool changed = true; changed;) {
            changed = false;
            for (auto link = all.rbegin(); link != all.rend(); ++link) {
                if (!removed[link->link] || !must_stay(*link)) continue;
                removed[link->link] = 0;
                changed = true;
            }
        }
    }
    return removed;
}

TEST(BalancedLinks, AreTheLargestBalancedSet) {
    const Scene scene = test::corridor();
    const test::LinkedScene linked(scene, 2, {.link_threshold = 0.2F, .least_edge = 1});
    const LinkSet links = linked.sorted();
    Progress progress;
    const Blockers blockers(scene, linked.tree);
    const auto visibility = classify_links(linked.tree, links, blockers, {}, progress);
    const auto removed = blocked_and_balanced(linked.tree, links, visibility, progress);
    EXPECT_EQ(removed, reference(linked.tree, links, visibility));
    const auto count = std::count(removed.begin(), removed.end(), 1);
    EXPECT_GT(count, 100);
    EXPECT_LT(count, std::count(visibility.begin(), visibility.end(), LinkVisibility::kNone));
}

// Links at random between any two nodes, clusters among them, a share of them blocked.
TEST(BalancedLinks, AreTheLargestBalancedSetOfAnyLinks) {
    const PatchTree tree = test::front_tree(test::floating_boxes(1), 0.3F);
    ASSERT_GT(tree.size(), 50U);
    std::size_t blocked = 0, removed = 0;
    for (std::uint32_t scene = 0; scene < 100; ++scene) {
        std::uint32_t state = hash_u32(scene + 1);
        const auto random = [&](std::size_t count) {
            return (state = hash_u32(state + 1)) % static_cast<std::uint32_t>(count);
        };
        // From a few links, which rarely meet, to so many that few can go.
        const std::size_t count = 20 + random(200);
        const std::size_t ends = 10 + random(tree.size() - 10);
        std::vector<RawLink> raw;
        for (std::size_t i = 0; i < count; ++i) {
            raw.push_back({static_cast<NodeId>(random(ends)), static_cast<NodeId>(random(ends)),
                           random(2) ? 0.01F : -0.01F, static_cast<std::uint16_t>(random(3))});
        }
        Progress progress;
        const LinkSet links = build_link_set(tree, DirectionBins(64), raw, progress);
        std::vector<LinkVisibility> visibility(links.links.size());
        const std::size_t share = 2 + random(10);
        for (LinkVisibility& v : visibility)
            v = random(share) ? LinkVisibility::kNone : LinkVisibility::kPartial;
        const auto found = blocked_and_balanced(tree, links, visibility, progress);
        ASSERT_EQ(found, reference(tree, links, visibility)) << "scene " << scene;
        blocked += static_cast<std::size_t>(
            std::count(visibility.begin(), visibility.end(), LinkVisibility::kNone));
        removed += static_cast<std::size_t>(std::count(found.begin(), found.end(), 1));
    }
    EXPECT_GT(removed, blocked / 10);
    EXPECT_LT(removed, blocked - blocked / 10);
}

}  // namespace
}  // namespace antiradiance
