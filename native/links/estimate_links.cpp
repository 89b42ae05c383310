// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/estimate_links.h"

#include "base/random.h"
#include "links/pair_geometry.h"

namespace antiradiance {

namespace {

constexpr std::uint32_t kSampledPairs = 16'384;  // 1 % off

}  // namespace

double estimate_links_without_clusters(const GrowingTree& tree) {
    std::vector<NodeId> surfaces;
    for (NodeId n = 0; n < static_cast<NodeId>(tree.size()); ++n) {
        if (!tree.node(n).is_cluster()) surfaces.push_back(n);
    }
    if (surfaces.size() < 2) return 0;
    const auto pick = [&](float u) -> const GrowingNode& {
        const auto count = static_cast<float>(surfaces.size());
        const auto i = std::min(static_cast<std::size_t>(u * count), surfaces.size() - 1);
        return tree.node(surfaces[i]);
    };
    std::size_t ways = 0;
    for (std::uint32_t i = 0; i < kSampledPairs; ++i) {
        const vec2 u = r2_sample(i, 1);
        const GrowingNode& source = pick(u.x);
        const GrowingNode& receiver = pick(u.y);
        if (side_of_plane(source, receiver) != PlaneSide::kBehind && !receiver.emits_only) ++ways;
    }
    const auto count = static_cast<double>(surfaces.size());
    return count * count * static_cast<double>(ways) / kSampledPairs;
}

}  // namespace antiradiance
