// SPDX-License-Identifier: GPL-3.0-or-later
#include "prune/link_index.h"

#include <algorithm>

namespace antiradiance {

LinkRange links_from(const LinkSet& links, SegmentId segment, NodeId source) {
    const Segment& s = links.segments[segment];
    const auto end = links.links.begin() + s.end;
    auto last = std::lower_bound(links.links.begin() + s.begin, end, source,
                                 [](const Link& l, NodeId n) { return l.source < n; });
    const auto first = last;
    while (last != end && last->source == source)
        ++last;
    return {static_cast<LinkId>(first - links.links.begin()),
            static_cast<LinkId>(last - links.links.begin())};
}

LinkIndex::LinkIndex(const PatchTree& tree, const LinkSet& links) : tree_(tree), links_(links) {
    by_receiver_.load(tree.size(), [&](const auto& visit) {
        for (SegmentId s = 0; s < links.segments.size(); ++s)
            visit(links.segments[s].receiver, s);
    });
}

SegmentId LinkIndex::segment(NodeId receiver, int bin) const {
    const auto b = static_cast<std::size_t>(bin);
    const std::span<const SegmentId> all = segments(receiver);
    const auto found = std::lower_bound(all.begin(), all.end(), links_.bin_segments[b]);
    return found != all.end() && *found < links_.bin_segments[b + 1] ? *found : kAbsent;
}

void BinSegments::load(const PatchTree& tree, const LinkSet& links, int bin) {
    segment_of_.resize(tree.size(), kAbsent);
    for (const NodeId n : loaded_)
        segment_of_[static_cast<std::size_t>(n)] = kAbsent;
    loaded_.clear();
    begin_ = links.bin_segments[static_cast<std::size_t>(bin)];
    end_ = links.bin_segments[static_cast<std::size_t>(bin) + 1];
    for (SegmentId s = begin_; s < end_; ++s) {
        const NodeId receiver = links.segments[s].receiver;
        segment_of_[static_cast<std::size_t>(receiver)] = s;
        loaded_.push_back(receiver);
    }
}

}  // namespace antiradiance
