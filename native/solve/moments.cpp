// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/moments.h"

namespace antiradiance {

std::vector<Moments> pull_moments(const PatchTree& tree, std::span<const vec3> radiance) {
    std::vector<Moments> sent(tree.size());
    for (std::size_t s = 0; s < tree.surfaces.size(); ++s) {
        if (tree.surfaces[s].lamp != kNone) continue;
        const auto n = static_cast<std::size_t>(tree.surface_node[s]);
        sent[static_cast<std::size_t>(tree.parent[n])].add(tree.normal[n],
                                                           tree.area[n] * radiance[n]);
    }
    for (std::size_t n = tree.size(); n-- > 1;) {
        if (tree.is_cluster(static_cast<NodeId>(n)))
            sent[static_cast<std::size_t>(tree.parent[n])] += sent[n];
    }
    return sent;
}

}  // namespace antiradiance
