// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/tested_pairs.h"

#include <algorithm>
#include <numeric>

#include "base/parallel.h"

namespace antiradiance {

TestedPairs::TestedPairs(std::size_t node_count, std::span<const TestedPair> pairs,
                         std::span<const float> shares, Progress& progress)
    : first_(node_count + 1, 0), entries_(pairs.size()) {
    for (const TestedPair& pair : pairs)
        ++first_[static_cast<std::size_t>(std::min(pair.a, pair.b)) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::uint32_t> end(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto [a, b] = std::minmax(pairs[i].a, pairs[i].b);
        entries_[end[static_cast<std::size_t>(a)]++] = {b, pairs[i].rays, shares[i]};
    }
    parallel_for_blocks(node_count, 256, progress, [&](std::size_t from, std::size_t to) {
        for (std::size_t n = from; n < to; ++n)
            std::ranges::sort(entries_.begin() + first_[n], entries_.begin() + first_[n + 1], {},
                              &Entry::other);
    });
}

std::optional<float> TestedPairs::find(NodeId a, NodeId b, int rays) const {
    const auto n = static_cast<std::size_t>(std::min(a, b));
    if (n + 1 >= first_.size()) return std::nullopt;
    const auto end = entries_.begin() + first_[n + 1];
    const auto entry = std::ranges::lower_bound(entries_.begin() + first_[n], end, std::max(a, b),
                                                {}, &Entry::other);
    if (entry == end || entry->other != std::max(a, b) || entry->rays != rays) return std::nullopt;
    return entry->share;
}

std::optional<float> EarlierPairs::find(const TestedPair& pair) const {
    const NodeId a = change.earlier(pair.a);
    const NodeId b = change.earlier(pair.b);
    if (a == kNone || b == kNone || change.may_be_between(change.box(pair.a), change.box(pair.b)))
        return std::nullopt;
    return tested.find(a, b, pair.rays);
}

}  // namespace antiradiance
