// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/shortest_links.h"

#include <gtest/gtest.h>

#include "links/build_link_set.h"
#include "support/scene_builder.h"
#include "support/tree_builder.h"

namespace antiradiance {
namespace {

// Four quads of 1 m2 above each other, the lowest cut into patches; links run down.
struct Stack {
    Scene scene;
    PatchTree tree;
    DirectionBins bins{32};
    std::vector<RawLink> raw;

    Stack() {
        const int m = test::add_material(scene, vec3(0.5F));
        for (int i = 0; i < 4; ++i)
            test::add_quad(scene, "Quad", vec3(0, 0, i), vec3(1, 0, 0), vec3(0, 1, 0), m);
        tree = test::front_tree(scene, 0.6F);
    }
    [[nodiscard]] NodeId quad(std::size_t i) const { return tree.surface_node[i]; }
    void link(NodeId source, NodeId receiver, float ff, std::uint16_t bin = 0) {
        raw.push_back({receiver, source, ff, bin});
    }
    // Sources that are left of a receiver's links.
    [[nodiscard]] std::vector<NodeId> left(NodeId receiver, std::size_t bin = 0) const {
        Progress progress;
        const LinkSet links = build_link_set(tree, bins, raw, progress);
        const std::vector<std::uint8_t> gone = all_but_shortest(tree, links, progress);
        std::vector<NodeId> sources;
        for (std::uint32_t s = links.bin_segments[bin]; s < links.bin_segments[bin + 1]; ++s) {
            if (links.segments[s].receiver != receiver) continue;
            for (std::uint32_t l = links.segments[s].begin; l < links.segments[s].end; ++l) {
                if (!gone[l]) sources.push_back(links.links[l].source);
            }
        }
        return sources;
    }
};

using Nodes = std::vector<NodeId>;

TEST(ShortestLinks, TheNearestSourceOfEachBinIsLeft) {
    Stack stack;
    const NodeId receiver = stack.quad(0);
    stack.link(stack.quad(3), receiver, 0.5F);
    stack.link(stack.quad(2), receiver, 0.1F);
    stack.link(stack.quad(3), receiver, 0.2F, 1);
    EXPECT_EQ(stack.left(receiver), Nodes{stack.quad(2)});
    EXPECT_EQ(stack.left(receiver, 1), Nodes{stack.quad(3)});
}

TEST(ShortestLinks, NoAntiradianceIsLeft) {
    Stack stack;
    stack.link(stack.quad(1), stack.quad(0), -0.1F);
    stack.link(stack.quad(2), stack.quad(0), 0.1F);
    EXPECT_EQ(stack.left(stack.quad(0)), Nodes{stack.quad(2)});
}

TEST(ShortestLinks, APatchSeesNothingBehindWhatItsParentSees) {
    Stack stack;
    const NodeId parent = stack.quad(0);
    const NodeId child = parent + 1;
    ASSERT_LT(child, stack.tree.subtree_end[static_cast<std::size_t>(parent)]);
    stack.link(stack.quad(1), parent, 0.1F);
    stack.link(stack.quad(2), child, 0.1F);
    EXPECT_EQ(stack.left(parent), Nodes{stack.quad(1)});
    EXPECT_EQ(stack.left(child), Nodes{});
    // But before it.
    stack.raw.clear();
    stack.link(stack.quad(2), parent, 0.1F);
    stack.link(stack.quad(1), child, 0.1F);
    EXPECT_EQ(stack.left(parent), Nodes{stack.quad(2)});
    EXPECT_EQ(stack.left(child), Nodes{stack.quad(1)});
}

}  // namespace
}  // namespace antiradiance
