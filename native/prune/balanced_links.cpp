// SPDX-License-Identifier: GPL-3.0-or-later
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>

#include "base/parallel.h"
#include "prune/link_visibility.h"

namespace antiradiance {

namespace {

class Balance {
public:
    Balance(const PatchTree& tree, const LinkSet& links,
            const std::vector<LinkVisibility>& visibility)
        : tree_(tree), links_(links), visibility_(visibility) {}

    // The largest balanced set of blocked links: whatever has to stay makes others stay.
    void judge_bin(int bin, std::vector<std::uint8_t>& removed) {
        load(bin);
        if (rows_.empty()) return;
        const LinkId begin = links_.segments[segments_.begin()].begin;
        const LinkId end = links_.segments[segments_.end() - 1].end;
        for (LinkId l = begin; l < end; ++l)
            removed[l] = visibility_[l] == LinkVisibility::kNone;
        for (bool changed = true; changed;) {
            changed = false;
            for (const Row& row : rows_) {
                for (LinkId l = first(row.segment); l < last(row.segment); ++l) {
                    if (!removed[l] || !must_stay(links_.links[l], row.receiver, removed)) continue;
                    removed[l] = 0;
                    changed = true;
                }
            }
        }
    }

private:
    struct Row {
        NodeId receiver;
        SegmentId segment;
    };

    void load(int bin) {
        segments_.load(tree_, links_, bin);
        rows_.clear();
        for (SegmentId s = segments_.begin(); s < segments_.end(); ++s)
            rows_.push_back({links_.segments[s].receiver, s});
        std::sort(rows_.begin(), rows_.end(),
                  [](const Row& a, const Row& b) { return a.receiver < b.receiver; });
    }
    [[nodiscard]] LinkId first(SegmentId s) const { return links_.segments[s].begin; }
    [[nodiscard]] LinkId last(SegmentId s) const { return links_.segments[s].end; }

    // Whether a node, one above or one below it receives a link for which test(link) holds.
    template <typename Test>
    [[nodiscard]] bool any_link_to(NodeId node, const std::vector<std::uint8_t>& removed,
                                   const Test& test) const {
        const auto any_in = [&](SegmentId s) {
            for (LinkId l = first(s); l < last(s); ++l) {
                if (!removed[l] && test(links_.links[l])) return true;
            }
            return false;
        };
        for (NodeId up = tree_.parent[static_cast<std::size_t>(node)];
             up != kNone && !tree_.is_cluster(up);
             up = tree_.parent[static_cast<std::size_t>(up)]) {
            if (segments_[up] != kAbsent && any_in(segments_[up])) return true;
        }
        const NodeId end = tree_.subtree_end[static_cast<std::size_t>(node)];
        auto row = std::lower_bound(rows_.begin(), rows_.end(), node,
                                    [](const Row& r, NodeId n) { return r.receiver < n; });
        for (; row != rows_.end() && row->receiver < end; ++row) {
            if (any_in(row->segment)) return true;
        }
        return false;
    }

    [[nodiscard]] bool must_stay(const Link& link, NodeId receiver,
                                 const std::vector<std::uint8_t>& removed) const {
        if (link.form_factor > 0) {
            return any_link_to(receiver, removed, [&](const Link& other) {
                return other.form_factor < 0 && sends(link.source, other.source, removed);
            });
        }
        return any_link_to(link.source, removed, [&](const Link& other) {
            return other.form_factor > 0 && sends(other.source, receiver, removed);
        });
    }

    // Whether light of a node, or of a patch above or below it, arrives at another.
    [[nodiscard]] bool sends(NodeId source, NodeId receiver,
                             const std::vector<std::uint8_t>& removed) const {
        return any_link_to(receiver, removed, [&](const Link& l) {
            return l.form_factor > 0 && (holds(l.source, source) || holds(source, l.source));
        });
    }
    [[nodiscard]] bool holds(NodeId upper, NodeId lower) const {
        return upper <= lower && lower < tree_.subtree_end[static_cast<std::size_t>(upper)];
    }

    const PatchTree& tree_;
    const LinkSet& links_;
    const std::vector<LinkVisibility>& visibility_;
    BinSegments segments_;
    std::vector<Row> rows_;  // of the bin, by receiver
};

}  // namespace

std::vector<std::uint8_t> blocked_and_balanced(const PatchTree& tree, const LinkSet& links,
                                               const std::vector<LinkVisibility>& visibility,
                                               Progress& progress) {
    std::vector<std::uint8_t> removed(links.links.size(), 0);
    tbb::enumerable_thread_specific<Balance> balances(
        [&] { return Balance(tree, links, visibility); });
    parallel_for(static_cast<std::size_t>(links.bins.count()), progress, [&](std::size_t bin) {
        balances.local().judge_bin(static_cast<int>(bin), removed);
    });
    return removed;
}

}  // namespace antiradiance
