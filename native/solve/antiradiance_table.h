// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "base/progress.h"
#include "hierarchy/patch_tree.h"
#include "links/link_set.h"

namespace antiradiance {

// A of Eq. 4, node by node and bin by bin: the radiance that a patch blocks of the light that
// travels along a bin. What a picture shoots behind each patch light.
struct AntiradianceTable {
    int bins = 0;
    // W/(m2 sr), never negative; inner patches: area average of their leaves.
    // Clusters: W/sr, the intensity that their patches block less what they send.
    std::vector<vec3> values;  // #nodes x #bins

    [[nodiscard]] std::span<const vec3> of(NodeId n) const {
        const auto count = static_cast<std::size_t>(bins);
        return {values.data() + static_cast<std::size_t>(n) * count, count};
    }
};

// The antiradiance that belongs to a converged radiance (#nodes, pulled): A = Phi / C from one
// gather of ray-tested links (operator G), or from a few sweeps of U where links carry
// antiradiance themselves.
[[nodiscard]] AntiradianceTable antiradiance_table(const PatchTree& tree, const LinkSet& links,
                                                   std::span<const vec3> radiance,
                                                   Progress& progress);

}  // namespace antiradiance
