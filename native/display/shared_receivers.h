// SPDX-License-Identifier: GPL-3.0-or-later
// Along silhouettes a pixel holds several fragments, each a part of it. Those of a surface that
// fills most of a pixel beside take that pixel's indirect light, which changes little from one
// pixel to the next: about half of all fragments need no sum over patches of their own.
#pragma once

#include <span>
#include <vector>

#include "display/gbuffer.h"
#include "hierarchy/patch_tree.h"

namespace antiradiance {

struct SharedReceivers {
    GBuffer receivers;              // fragments that are to be lit; no images
    std::vector<std::uint32_t> of;  // #fragments: into receivers.fragments

    // values: one for each receiver. Result: one for each fragment of the whole buffer.
    [[nodiscard]] std::vector<vec3> spread(std::span<const vec3> values) const;
};

// Fragments of less than half a pixel share with one of more than half in the 8 pixels around, of
// the same surface and no farther than a leaf's radius.
[[nodiscard]] SharedReceivers share_receivers(const PatchTree& tree, const GBuffer& buffer);

}  // namespace antiradiance
