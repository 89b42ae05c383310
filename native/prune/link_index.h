// SPDX-License-Identifier: GPL-3.0-or-later
// Finds links by their ends. A link set is sorted by bin and receiver already, and a pair of
// patches has one direction: no table over pairs of nodes is needed.
#pragma once

#include <span>
#include <vector>

#include "hierarchy/patch_tree.h"
#include "links/link_set.h"
#include "prune/node_table.h"

namespace antiradiance {

using SegmentId = std::uint32_t;  // index into LinkSet::segments
using LinkId = std::uint32_t;     // index into LinkSet::links
inline constexpr std::uint32_t kAbsent = 0xFFFFFFFF;

// The links of one source in a segment: [first, last), - before +; empty if there are none.
struct LinkRange {
    LinkId first, last;
};
[[nodiscard]] LinkRange links_from(const LinkSet& links, SegmentId segment, NodeId source);

class LinkIndex {
public:
    // Borrows both.
    LinkIndex(const PatchTree& tree, const LinkSet& links);

    // The segments of a receiver, ascending and so by bin.
    [[nodiscard]] std::span<const SegmentId> segments(NodeId receiver) const {
        return by_receiver_.of(receiver);
    }
    [[nodiscard]] SegmentId segment(NodeId receiver, int bin) const;  // kAbsent: no links there

    // The + link from source to receiver, which may have several where they touch: visit(LinkId)
    // returns true to stop.
    template <typename Visit>
    void for_plus_links(NodeId source, NodeId receiver, const Visit& visit) const {
        const vec3 d = tree_.center[static_cast<std::size_t>(receiver)] -
                       tree_.center[static_cast<std::size_t>(source)];
        const float reach = tree_.radius[static_cast<std::size_t>(receiver)] +
                            tree_.radius[static_cast<std::size_t>(source)];
        if (glm::dot(d, d) >= kTouching * reach * reach) {
            const SegmentId only = segment(receiver, links_.bins.bin(d));
            if (only != kAbsent) visit_plus(only, source, visit);
            return;
        }
        for (const SegmentId s : segments(receiver)) {
            if (visit_plus(s, source, visit)) return;
        }
    }

    [[nodiscard]] std::size_t bytes() const { return by_receiver_.bytes(); }

private:
    // Links of touching pairs are spread over bins; a little more, as the tree's spheres are
    // rounded.
    static constexpr float kTouching = 1.001F;

    template <typename Visit>
    bool visit_plus(SegmentId segment, NodeId source, const Visit& visit) const {
        const LinkRange range = links_from(links_, segment, source);
        for (LinkId l = range.first; l < range.last; ++l) {
            if (links_.links[l].form_factor > 0 && visit(l)) return true;
        }
        return false;
    }

    const PatchTree& tree_;
    const LinkSet& links_;
    NodeTable<SegmentId> by_receiver_;
};

// The segments of one bin by receiver, in constant time: a thread's table, loaded bin by bin.
class BinSegments {
public:
    void load(const PatchTree& tree, const LinkSet& links, int bin);
    [[nodiscard]] SegmentId operator[](NodeId receiver) const {
        return segment_of_[static_cast<std::size_t>(receiver)];
    }
    [[nodiscard]] SegmentId begin() const { return begin_; }
    [[nodiscard]] SegmentId end() const { return end_; }

private:
    std::vector<SegmentId> segment_of_;  // #nodes; kAbsent
    std::vector<NodeId> loaded_;         // receivers of the bin in the table
    SegmentId begin_ = 0, end_ = 0;      // of the bin
};

}  // namespace antiradiance
