// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "hierarchy/patch_tree.h"
#include "links/blocking_planes.h"
#include "links/link_set.h"
#include "scene/ray_scene.h"

namespace antiradiance {

// Rows that rays have weighted, where others are implicit.
struct RowSubset {
    std::span<const std::uint8_t> rows;  // #segments, 1: takes part; empty: all
    std::span<const float> share;        // #nodes, of the hemisphere that they stand for; empty: 1
};

// The form factors of a receiver must add up to the share of its hemisphere that surfaces cover;
// centre-to-centre links and a few rays miss that by some percent, which adds up over bounces.
// What lies behind a blocking plane covers nothing, as no link comes from there.
// Returns for every leaf (covered share by cosine-weighted rays) / (sum of its + links), clamped to
// [0.6, 1.5]; 1 at other nodes.  // #nodes
std::vector<float> row_scales(const PatchTree& tree, const LinkSet& links, const RowSubset& subset,
                              const RayScene& rays, const BlockingPlanes& planes,
                              Progress& progress);

}  // namespace antiradiance
