// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/link_pairs.h"

#include <algorithm>
#include <numeric>

namespace antiradiance {

namespace {

// A + link at the smaller of its nodes.
struct PairedLink {
    NodeId larger;
    NodeId receiver;
    std::uint32_t link;
};

template <typename Visit>
void for_radiance_links(const LinkSet& links, const Visit& visit) {
    for (const Segment& s : links.segments) {
        for (std::uint32_t l = s.begin; l < s.end; ++l) {
            if (links.links[l].form_factor > 0) visit(l, links.links[l].source, s.receiver);
        }
    }
}

}  // namespace

LinkPairs pair_links(const PatchTree& tree, const LinkSet& links) {
    // By the smaller node through counting, then each node's few by the larger.
    std::vector<std::uint32_t> begin(tree.size() + 1, 0);
    for_radiance_links(links, [&](std::uint32_t, NodeId source, NodeId receiver) {
        ++begin[static_cast<std::size_t>(std::min(source, receiver)) + 1];
    });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<PairedLink> by_node(begin.back());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for_radiance_links(links, [&](std::uint32_t l, NodeId source, NodeId receiver) {
        const auto [smaller, larger] = std::minmax(source, receiver);
        by_node[next[static_cast<std::size_t>(smaller)]++] = {larger, receiver, l};
    });

    LinkPairs result;
    result.of_link.assign(links.links.size(), kNoPair);
    for (std::size_t n = 0; n < tree.size(); ++n) {
        const auto of_node = std::span(by_node).subspan(begin[n], begin[n + 1] - begin[n]);
        std::ranges::stable_sort(of_node, {}, &PairedLink::larger);
        for (std::size_t i = 0; i < of_node.size();) {
            TestedPair pair{static_cast<NodeId>(n), of_node[i].larger};
            double to_a = 0;
            double to_b = 0;
            for (; i < of_node.size() && of_node[i].larger == pair.b; ++i) {
                const auto [larger, receiver, l] = of_node[i];
                const Link& link = links.links[l];
                (receiver == pair.a ? to_a : to_b) +=
                    link_transfer(tree, link.source, receiver, link.form_factor);
                result.of_link[l] = static_cast<std::uint32_t>(result.pairs.size());
            }
            pair.transfer = std::max(to_a, to_b);
            result.pairs.push_back(pair);
        }
    }
    return result;
}

std::vector<std::uint8_t> weigh_links(LinkSet& links, const LinkPairs& pairs,
                                      std::span<const float> visibility,
                                      std::span<const std::uint8_t> rows) {
    std::vector<std::uint8_t> gone(links.links.size(), 0);
    for (std::size_t s = 0; s < links.segments.size(); ++s) {
        if (!rows.empty() && !rows[s]) continue;
        for (std::uint32_t l = links.segments[s].begin; l < links.segments[s].end; ++l) {
            const std::uint32_t pair = pairs.of_link[l];
            links.links[l].form_factor *= pair == kNoPair ? 0.0F : visibility[pair];
            gone[l] = links.links[l].form_factor == 0;
        }
    }
    return gone;
}

}  // namespace antiradiance
