// SPDX-License-Identifier: GPL-3.0-or-later
#include "prune/for_each_bin.h"
#include "prune/link_visibility.h"

namespace antiradiance {

namespace {

class RequiredLinks {
public:
    RequiredLinks(const PatchTree& tree, const LinkSet& links, const LinkIndex& index,
                  const std::vector<LinkVisibility>& visibility)
        : tree_(tree), links_(links), index_(index), visibility_(visibility) {}

    void judge_bin(int bin, std::vector<std::uint8_t>& removed) {
        segments_.load(tree_, links_, bin);
        for (SegmentId s = segments_.begin(); s < segments_.end(); ++s) {
            const Segment& row = links_.segments[s];
            for (LinkId l = row.begin; l < row.end; ++l) {
                if (visibility_[l] != LinkVisibility::kNone) continue;
                const Link& link = links_.links[l];
                removed[l] = link.form_factor > 0 || !is_required(link.source, row.receiver);
            }
        }
    }

private:
    // blocker: the S' of algorithm 3.
    [[nodiscard]] bool is_required(NodeId blocker, NodeId receiver) const {
        for (NodeId up = blocker; up != kNone; up = tree_.parent[static_cast<std::size_t>(up)]) {
            if (hides_in_part(up, receiver)) return true;
        }
        return false;
    }

    [[nodiscard]] bool hides_in_part(NodeId lit, NodeId receiver) const {
        const SegmentId s = segments_[lit];
        if (s == kAbsent) return false;
        for (LinkId l = links_.segments[s].begin; l < links_.segments[s].end; ++l) {
            if (links_.links[l].form_factor > 0 && visibility_[l] != LinkVisibility::kNone &&
                is_seen_in_part(links_.links[l].source, receiver))
                return true;
        }
        return false;
    }

    [[nodiscard]] bool is_seen_in_part(NodeId source, NodeId receiver) const {
        const NodeId parent = tree_.parent[static_cast<std::size_t>(receiver)];
        return is_partial(source, receiver) || (parent != kNone && is_partial(source, parent));
    }

    [[nodiscard]] bool is_partial(NodeId source, NodeId receiver) const {
        bool partial = false;
        index_.for_plus_links(source, receiver, [&](LinkId l) {
            partial = visibility_[l] == LinkVisibility::kPartial;
            return partial;
        });
        return partial;
    }

    const PatchTree& tree_;
    const LinkSet& links_;
    const LinkIndex& index_;
    const std::vector<LinkVisibility>& visibility_;
    BinSegments segments_;
};

}  // namespace

std::vector<std::uint8_t> blocked_and_not_required(const PatchTree& tree, const LinkSet& links,
                                                   const LinkIndex& index,
                                                   const std::vector<LinkVisibility>& visibility,
                                                   Progress& progress) {
    std::vector<std::uint8_t> removed(links.links.size(), 0);
    for_each_bin(
        links, progress, [&] { return RequiredLinks(tree, links, index, visibility); },
        [&](RequiredLinks& required, int bin) { required.judge_bin(bin, removed); });
    return removed;
}

}  // namespace antiradiance
