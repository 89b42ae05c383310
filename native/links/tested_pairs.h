// SPDX-License-Identifier: GPL-3.0-or-later
// What rays have found of pairs of nodes, kept for a later state of the scene.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hierarchy/scene_change.h"
#include "links/visibility.h"

namespace antiradiance {

class TestedPairs {
public:
    TestedPairs() = default;
    // shares: #pairs, as trace_pairs() returns them. Copies all; 12 bytes a pair.
    TestedPairs(std::size_t node_count, std::span<const TestedPair> pairs,
                std::span<const float> shares, Progress& progress);

    // The share of two nodes that as many rays have tested, whichever comes first.
    [[nodiscard]] std::optional<float> find(NodeId a, NodeId b, int rays) const;

private:
    struct Entry {
        NodeId other;  // the larger number
        int rays;
        float share;
    };
    std::vector<std::uint32_t> first_;  // #nodes + 1, into entries_: pairs whose smaller one it is
    std::vector<Entry> entries_;        // of each node ascending by `other`
};

// Pairs of an earlier state of the scene.
struct EarlierPairs {
    const SceneChange& change;
    const TestedPairs& tested;

    // What rays found then, if they would find the same now.
    [[nodiscard]] std::optional<float> find(const TestedPair& pair) const;
};

}  // namespace antiradiance
