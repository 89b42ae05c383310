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

LinkIndex::LinkIndex(const PatchTree& tree, const LinkSet& links)
    : tree_(tree),
      links_(links),
      by_receiver_(links.segments.size()),
      of_receiver_(tree.size() + 1, 0) {
    for (const Segment& s : links.segments)
        ++of_receiver_[static_cast<std::size_t>(s.receiver) + 1];
    for (std::size_t n = 0; n < tree.size(); ++n)
        of_receiver_[n + 1] += of_receiver_[n];
    std::vector<std::uint32_t> fill(of_receiver_.begin(), of_receiver_.end() - 1);
    for (SegmentId s = 0; s < links.segments.size(); ++s)
        by_receiver_[fill[static_cast<std::size_t>(links.segments[s].receiver)]++] = s;
}

std::span<const SegmentId> LinkIndex::segments(NodeId receiver) const {
    const auto r = static_cast<std::size_t>(receiver);
    return std::span(by_receiver_).subspan(of_receiver_[r], of_receiver_[r + 1] - of_receiver_[r]);
}

SegmentId LinkIndex::segment(NodeId receiver, int bin) const {
    const auto b = static_cast<std::size_t>(bin);
    const std::span<const SegmentId> all = segments(receiver);
    const auto found = std::lower_bound(all.begin(), all.end(), links_.bin_segments[b]);
    return found != all.end() && *found < links_.bin_segments[b + 1] ? *found : kAbsent;
}

std::size_t LinkIndex::bytes() const {
    return by_receiver_.size() * sizeof(SegmentId) + of_receiver_.size() * sizeof(std::uint32_t);
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
