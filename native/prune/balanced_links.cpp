// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include "prune/for_each_bin.h"
#include "prune/link_index.h"
#include "prune/link_visibility.h"
#include "prune/node_table.h"

namespace antiradiance {

namespace {

// Below, two nodes are related where one is the other or lies under it.

struct PlacedLink {
    NodeId source, receiver;
    LinkId link;
};
using LinkTable = NodeTable<PlacedLink>;

// The tree, with or without its clusters: mostly they have no links.
struct Relations {
    const std::vector<NodeId>* parent;
    const std::vector<NodeId>* subtree_end;

    [[nodiscard]] NodeId above(NodeId n) const { return (*parent)[static_cast<std::size_t>(n)]; }
    [[nodiscard]] NodeId end(NodeId n) const { return (*subtree_end)[static_cast<std::size_t>(n)]; }

    // visit(link) for the links at all nodes that are related to one.
    template <typename Visit>
    void for_related(const LinkTable& table, NodeId node, const Visit& visit) const {
        for (NodeId up = above(node); up != kNone; up = above(up)) {
            for (const PlacedLink& l : table.of(up))
                visit(l);
        }
        for (const PlacedLink& l : table.of_nodes(node, end(node)))
            visit(l);
    }
};

// A set of nodes, of which only those matter that lie under no other: whatever is related to any of
// them is related to one of these.
class TopNodes {
public:
    // nodes: ascending.
    void assign(const Relations& tree, std::span<const NodeId> nodes) {
        nodes_.clear();
        NodeId end = 0;  // in preorder, what lies under a node follows it
        for (const NodeId n : nodes) {
            if (n < end) continue;
            nodes_.push_back(n);
            end = tree.end(n);
        }
    }
    void add(const Relations& tree, NodeId n) {
        const auto after = std::upper_bound(nodes_.begin(), nodes_.end(), n);
        if (after != nodes_.begin() && n < tree.end(*(after - 1))) return;
        const auto last = std::lower_bound(after, nodes_.end(), tree.end(n));
        nodes_.insert(nodes_.erase(after, last), n);
    }
    [[nodiscard]] bool any_related_to(const Relations& tree, NodeId n) const {
        const auto after = std::upper_bound(nodes_.begin(), nodes_.end(), n);
        return (after != nodes_.end() && *after < tree.end(n)) ||
               (after != nodes_.begin() && n < tree.end(*(after - 1)));
    }
    [[nodiscard]] auto begin() const { return nodes_.begin(); }
    [[nodiscard]] auto end() const { return nodes_.end(); }

private:
    std::vector<NodeId> nodes_;  // ascending
};

// Of the links of one bin and sign those that are not removed: what reaches a node or one that is
// related to it.
class LeftLinks {
public:
    // Borrows both.
    LeftLinks(const Relations& tree, const std::vector<std::uint8_t>& removed)
        : tree_(tree),
          removed_(removed),
          sources_(tree.subtree_end->size()),
          is_known_(tree.subtree_end->size(), 0) {}

    // Of one bin from now on; for_each as NodeTable::load() has it: all its links by receiver,
    // removed or not.
    template <typename ForEach>
    void load(const Relations& tree, const ForEach& for_each) {
        tree_ = tree;
        links_.load(sources_.size(), for_each);
        for (const NodeId n : known_)
            is_known_[static_cast<std::size_t>(n)] = 0;
        known_.clear();
    }

    // Nodes whose links arrive.
    [[nodiscard]] const TopNodes& sources_to(NodeId receiver) {
        const auto r = static_cast<std::size_t>(receiver);
        if (is_known_[r]) return sources_[r];
        scratch_.clear();
        tree_.for_related(links_, receiver, [&](const PlacedLink& l) {
            if (!removed_[l.link]) scratch_.push_back(l.source);
        });
        std::sort(scratch_.begin(), scratch_.end());
        sources_[r].assign(tree_, scratch_);
        is_known_[r] = 1;
        known_.push_back(receiver);
        return sources_[r];
    }
    // Whether a link of a node that is related to the source arrives.
    [[nodiscard]] bool reach(NodeId source, NodeId receiver) {
        return sources_to(receiver).any_related_to(tree_, source);
    }

    // A link that is no longer removed.
    void add(const PlacedLink& link) {
        const auto add_to = [&](NodeId n) {
            if (is_known_[static_cast<std::size_t>(n)])
                sources_[static_cast<std::size_t>(n)].add(tree_, link.source);
        };
        for (NodeId up = tree_.above(link.receiver); up != kNone; up = tree_.above(up))
            add_to(up);
        for (NodeId n = link.receiver; n < tree_.end(link.receiver); ++n)
            add_to(n);
    }

private:
    Relations tree_;
    const std::vector<std::uint8_t>& removed_;
    LinkTable links_;
    std::vector<TopNodes> sources_;       // #nodes, of those that are known
    std::vector<std::uint8_t> is_known_;  // #nodes
    std::vector<NodeId> known_;
    std::vector<NodeId> scratch_;
};

// + links S -> X and S' -> R and a - link X' -> R', where S and S' are related, X and X', R and R':
// if the first is left, the other two are left or removed together. From the set without any
// blocked link, those that break this are put back until none does.
class Balance {
public:
    // patches_above: #nodes, each patch's parent where that is one.
    Balance(const PatchTree& tree, const std::vector<NodeId>& patches_above, const LinkSet& links,
            const std::vector<LinkVisibility>& visibility, std::vector<std::uint8_t>& removed)
        : tree_(tree),
          patches_above_(patches_above),
          links_(links),
          visibility_(visibility),
          removed_(removed),
          relations_{&tree.parent, &tree.subtree_end},
          plus_(relations_, removed),
          minus_(relations_, removed) {}

    void judge_bin(int bin) {
        if (!load(bin)) return;
        // By receiver, as neighbours ask for the same.
        for (const PlacedLink& l : blocked_plus_to_.all()) {
            if (plus_must_stay(l)) put_back(l);
        }
        for (const PlacedLink& l : blocked_minus_to_.all()) {
            if (minus_must_stay(l)) put_back(l);
        }
        while (!put_back_.empty()) {
            const PlacedLink l = put_back_.back();
            put_back_.pop_back();
            links_.links[l.link].form_factor > 0 ? follow_plus(l) : follow_minus(l);
        }
    }

private:
    enum Kind : std::uint8_t { kMinus = 0, kPlus = 1, kBlockedMinus = 2, kBlockedPlus = 3 };

    [[nodiscard]] auto by_receiver(Kind a, Kind b) const {
        return [this, a, b](const auto& visit) {
            for (const Kind kind : {a, b}) {
                for (const PlacedLink& l : all_[kind])
                    visit(l.receiver, l);
            }
        };
    }

    // Removes all blocked links; false: there are none.
    bool load(int bin) {
        for (std::vector<PlacedLink>& of_kind : all_)
            of_kind.clear();
        bool clusters = false;
        const auto b = static_cast<std::size_t>(bin);
        for (SegmentId s = links_.bin_segments[b]; s < links_.bin_segments[b + 1]; ++s) {
            const Segment& row = links_.segments[s];
            clusters = clusters || tree_.is_cluster(row.receiver);
            for (LinkId l = row.begin; l < row.end; ++l) {
                const Link& link = links_.links[l];
                clusters = clusters || tree_.is_cluster(link.source);
                removed_[l] = visibility_[l] == LinkVisibility::kNone ? 1 : 0;
                // Signs and verdicts follow no order: a branch would be guessed wrong.
                const std::size_t kind = 2 * removed_[l] + (link.form_factor > 0 ? 1U : 0U);
                all_[kind].push_back({link.source, row.receiver, l});
            }
        }
        if (all_[kBlockedPlus].empty() && all_[kBlockedMinus].empty()) return false;

        relations_.parent = clusters ? &tree_.parent : &patches_above_;
        plus_.load(relations_, by_receiver(kPlus, kBlockedPlus));
        minus_.load(relations_, by_receiver(kMinus, kBlockedMinus));
        index(kBlockedPlus, &PlacedLink::source, blocked_plus_from_);
        index(kBlockedPlus, &PlacedLink::receiver, blocked_plus_to_);
        index(kBlockedMinus, &PlacedLink::source, blocked_minus_from_);
        index(kBlockedMinus, &PlacedLink::receiver, blocked_minus_to_);
        return true;
    }
    [[nodiscard]] bool is_plus(const PlacedLink& l) const {
        return links_.links[l.link].form_factor > 0;
    }

    void index(Kind kind, NodeId PlacedLink::*end, LinkTable& table) const {
        table.load(tree_.size(), [&](const auto& visit) {
            for (const PlacedLink& l : all_[kind])
                visit(l.*end, l);
        });
    }

    // Whether the antiradiance of some X that the light reaches as well is taken from R.
    [[nodiscard]] bool plus_must_stay(const PlacedLink& l) {
        const TopNodes& hidden_by = minus_.sources_to(l.receiver);
        return std::any_of(hidden_by.begin(), hidden_by.end(),
                           [&](NodeId x) { return plus_.reach(l.source, x); });
    }
    // Whether some S lights both X and R.
    [[nodiscard]] bool minus_must_stay(const PlacedLink& l) {
        const TopNodes& lit_by = plus_.sources_to(l.receiver);
        return std::any_of(lit_by.begin(), lit_by.end(),
                           [&](NodeId s) { return plus_.reach(s, l.source); });
    }

    void put_back(const PlacedLink& l) {
        removed_[l.link] = 0;
        (is_plus(l) ? plus_ : minus_).add(l);
        put_back_.push_back(l);
    }
    template <typename Test>
    void put_back_related(const LinkTable& blocked, NodeId node, const Test& must_stay) {
        relations_.for_related(blocked, node, [&](const PlacedLink& l) {
            if (removed_[l.link] && must_stay(l)) put_back(l);
        });
    }

    // What must stay because S -> R, or S -> X, does.
    void follow_plus(const PlacedLink& stays) {
        put_back_related(blocked_minus_to_, stays.receiver,
                         [&](const PlacedLink& l) { return plus_.reach(stays.source, l.source); });
        const NodeId x = stays.receiver;
        put_back_related(blocked_minus_from_, x, [&](const PlacedLink& l) {
            return plus_.reach(stays.source, l.receiver);
        });
        put_back_related(blocked_plus_from_, stays.source,
                         [&](const PlacedLink& l) { return minus_.reach(x, l.receiver); });
    }
    // And because X -> R does.
    void follow_minus(const PlacedLink& stays) {
        put_back_related(blocked_plus_to_, stays.receiver,
                         [&](const PlacedLink& l) { return plus_.reach(l.source, stays.source); });
    }

    const PatchTree& tree_;
    const std::vector<NodeId>& patches_above_;
    const LinkSet& links_;
    const std::vector<LinkVisibility>& visibility_;
    std::vector<std::uint8_t>& removed_;  // of other bins as well, which are not touched
    // Of the bin:
    Relations relations_;
    LeftLinks plus_, minus_;
    std::array<std::vector<PlacedLink>, 4> all_;
    LinkTable blocked_plus_from_, blocked_plus_to_;  // by source, by receiver
    LinkTable blocked_minus_from_, blocked_minus_to_;
    std::vector<PlacedLink> put_back_;  // whose consequences are still to be found
};

}  // namespace

std::vector<std::uint8_t> blocked_and_balanced(const PatchTree& tree, const LinkSet& links,
                                               const std::vector<LinkVisibility>& visibility,
                                               Progress& progress) {
    std::vector<std::uint8_t> removed(links.links.size(), 0);
    std::vector<NodeId> patches_above = tree.parent;
    for (NodeId& up : patches_above) {
        if (up != kNone && tree.is_cluster(up)) up = kNone;
    }
    for_each_bin(
        links, progress, [&] { return Balance(tree, patches_above, links, visibility, removed); },
        [](Balance& balance, int bin) { balance.judge_bin(bin); });
    return removed;
}

}  // namespace antiradiance
