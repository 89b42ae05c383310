// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/types.h"

namespace antiradiance {

// Entries by node, those of a subtree next to each other.
template <typename Entry>
class NodeTable {
public:
    // for_each(visit) calls visit(node, entry) for all entries; it is called twice. Those of a node
    // stay in that order.
    template <typename ForEach>
    void load(std::size_t node_count, const ForEach& for_each) {
        first_.assign(node_count + 2, 0);
        for_each([&](NodeId n, const Entry&) { ++first_[static_cast<std::size_t>(n) + 2]; });
        for (std::size_t n = 2; n < first_.size(); ++n)
            first_[n] += first_[n - 1];
        entries_.resize(first_.back());
        // What is the end of a node's entries in the end, counts them until then.
        for_each([&](NodeId n, const Entry& e) {
            entries_[first_[static_cast<std::size_t>(n) + 1]++] = e;
        });
    }

    [[nodiscard]] std::span<const Entry> all() const { return entries_; }
    [[nodiscard]] std::span<const Entry> of(NodeId n) const { return of_nodes(n, n + 1); }
    // Of nodes [begin, end): n to tree.subtree_end[n] is a subtree.
    [[nodiscard]] std::span<const Entry> of_nodes(NodeId begin, NodeId end) const {
        const std::uint32_t first = first_[static_cast<std::size_t>(begin)];
        return std::span(entries_).subspan(first, first_[static_cast<std::size_t>(end)] - first);
    }

    [[nodiscard]] std::size_t bytes() const {
        return entries_.size() * sizeof(Entry) + first_.size() * sizeof(first_[0]);
    }

private:
    std::vector<std::uint32_t> first_;  // #nodes + 2: into entries_
    std::vector<Entry> entries_;
};

}  // namespace antiradiance
