// SPDX-License-Identifier: GPL-3.0-or-later
#include "pairs.h"

namespace antiradiance::bench {

Pairs all_pairs(const LinkSet& set) {
    Pairs all;
    for (const Segment& s : set.segments) {
        for (std::uint32_t l = s.begin; l < s.end; ++l) {
            const Link& link = set.links[l];
            if (link.form_factor < 0) continue;
            const auto first = static_cast<std::uint32_t>(all.links.size());
            all.links.push_back({s.receiver, link.source, link.form_factor, 0});
            all.pairs.push_back({link.source, s.receiver, first, 1});
        }
    }
    return all;
}

}  // namespace antiradiance::bench
