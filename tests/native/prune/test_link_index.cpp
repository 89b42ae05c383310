// SPDX-License-Identifier: GPL-3.0-or-later
#include "prune/link_index.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "support/linked_scene.h"
#include "support/scenes.h"

namespace antiradiance {
namespace {

struct Linked {
    test::LinkedScene scene{test::office(), 0.8F, {.link_threshold = 0.05F, .least_edge = 0.4F}};
    LinkSet links = scene.sorted();
    LinkIndex index{scene.tree, links};
};

TEST(LinkIndex, FindsEveryPlusLinkAndNoOther) {
    const Linked linked;
    const LinkSet& links = linked.links;
    std::map<std::pair<NodeId, NodeId>, std::set<LinkId>> expected;
    for (const Segment& s : links.segments) {
        for (LinkId l = s.begin; l < s.end; ++l) {
            auto& of_pair = expected[{links.links[l].source, s.receiver}];
            if (links.links[l].form_factor > 0) of_pair.insert(l);
        }
    }
    ASSERT_GT(links.antiradiance_count, 1000U);
    std::size_t spread = 0;
    for (const auto& [pair, of_pair] : expected) {
        std::set<LinkId> found;
        linked.index.for_plus_links(pair.first, pair.second, [&](LinkId l) {
            found.insert(l);
            return false;
        });
        ASSERT_EQ(found, of_pair) << pair.first << " -> " << pair.second;
        spread += of_pair.size() > 1 ? 1 : 0;
    }
    EXPECT_GT(spread, 100U) << "touching pairs have links in several bins";
    for (NodeId n = 0; n < static_cast<NodeId>(linked.scene.tree.size()); ++n)
        linked.index.for_plus_links(n, n, [&](LinkId) { return ADD_FAILURE() << n, true; });
}

TEST(LinkIndex, FindsSegmentsByReceiverAndBin) {
    const Linked linked;
    BinSegments table;
    std::size_t found = 0;
    for (int b = 0; b < linked.links.bins.count(); ++b) {
        table.load(linked.scene.tree, linked.links, b);
        for (NodeId n = 0; n < static_cast<NodeId>(linked.scene.tree.size()); ++n) {
            const SegmentId s = linked.index.segment(n, b);
            ASSERT_EQ(table[n], s);
            if (s == kAbsent) continue;
            ASSERT_EQ(linked.links.segments[s].receiver, n);
            ++found;
        }
    }
    EXPECT_EQ(found, linked.links.segments.size());
}

TEST(LinkIndex, StaysSmall) {
    const Linked linked;
    EXPECT_LT(linked.index.bytes(), 24 * linked.links.links.size());
}

}  // namespace
}  // namespace antiradiance
