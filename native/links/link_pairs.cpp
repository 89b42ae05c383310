// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/link_pairs.h"

#include <tbb/parallel_sort.h>

#include <algorithm>

namespace antiradiance {

LinkPairs pair_links(const PatchTree& tree, const LinkSet& links) {
    struct Keyed {
        std::uint64_t key;  // the smaller node, the larger
        std::uint32_t link;
        NodeId receiver;
    };
    std::vector<Keyed> keyed;
    keyed.reserve(links.radiance_count);
    for (const Segment& s : links.segments) {
        for (std::uint32_t l = s.begin; l < s.end; ++l) {
            if (links.links[l].form_factor < 0) continue;
            const auto [low, high] = std::minmax(links.links[l].source, s.receiver);
            keyed.push_back(
                {static_cast<std::uint64_t>(low) << 32U | static_cast<std::uint64_t>(high), l,
                 s.receiver});
        }
    }
    tbb::parallel_sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) {
        return a.key != b.key ? a.key < b.key : a.link < b.link;
    });

    LinkPairs result;
    result.of_link.assign(links.links.size(), kNoPair);
    for (std::size_t i = 0; i < keyed.size();) {
        TestedPair pair{static_cast<NodeId>(keyed[i].key >> 32U),
                        static_cast<NodeId>(keyed[i].key & 0xFFFFFFFFU)};
        double to_a = 0;
        double to_b = 0;
        const std::uint64_t key = keyed[i].key;
        for (; i < keyed.size() && keyed[i].key == key; ++i) {
            const Link& link = links.links[keyed[i].link];
            (keyed[i].receiver == pair.a ? to_a : to_b) +=
                link_transfer(tree, link.source, keyed[i].receiver, link.form_factor);
            result.of_link[keyed[i].link] = static_cast<std::uint32_t>(result.pairs.size());
        }
        pair.transfer = std::max(to_a, to_b);
        result.pairs.push_back(pair);
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
