// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/shortest_links.h"

#include <algorithm>
#include <limits>

#include "base/parallel.h"

namespace antiradiance {

namespace {

constexpr std::uint32_t kNoLink = std::numeric_limits<std::uint32_t>::max();

struct Nearest {
    NodeId receiver;
    std::uint32_t link = kNoLink;
    float distance = std::numeric_limits<float>::max();  // m
};

Nearest nearest_of(const PatchTree& tree, const LinkSet& links, const Segment& row) {
    Nearest nearest{row.receiver};
    for (std::uint32_t l = row.begin; l < row.end; ++l) {
        const Link& link = links.links[l];
        if (link.form_factor < 0) continue;
        const float distance = glm::distance(tree.center[static_cast<std::size_t>(link.source)],
                                             tree.center[static_cast<std::size_t>(row.receiver)]);
        if (distance < nearest.distance) {
            nearest.link = l;
            nearest.distance = distance;
        }
    }
    return nearest;
}

}  // namespace

std::vector<std::uint8_t> all_but_shortest(const PatchTree& tree, const LinkSet& links,
                                           Progress& progress) {
    std::vector<std::uint8_t> gone(links.links.size(), 1);
    parallel_for(static_cast<std::size_t>(links.bins.count()), progress, [&](std::size_t bin) {
        std::vector<Nearest> rows;
        for (std::uint32_t s = links.bin_segments[bin]; s < links.bin_segments[bin + 1]; ++s)
            rows.push_back(nearest_of(tree, links, links.segments[s]));
        // In preorder the rows above one are those before it whose subtrees have not ended.
        std::sort(rows.begin(), rows.end(),
                  [](const Nearest& a, const Nearest& b) { return a.receiver < b.receiver; });
        std::vector<Nearest> above;
        for (const Nearest& row : rows) {
            while (!above.empty() &&
                   row.receiver >=
                       tree.subtree_end[static_cast<std::size_t>(above.back().receiver)])
                above.pop_back();
            const bool hidden = !above.empty() && above.back().distance <= row.distance;
            if (row.link == kNoLink || hidden) continue;
            gone[row.link] = 0;
            above.push_back(row);
        }
    });
    return gone;
}

}  // namespace antiradiance
