// SPDX-License-Identifier: GPL-3.0-or-later
// The link mesh: who lights whom, in which direction bin, with which form factor and sign.
#pragma once

#include <vector>

#include "base/types.h"
#include "links/direction_bins.h"

namespace antiradiance {

// One directed link, 8 bytes; its receiver and bin are those of its segment.
// form_factor > 0: a + link, carries the radiance of `source` (r lies in front of s).
// form_factor < 0: a - link, carries the antiradiance of `source` (r lies behind s); IMPLICIT only.
// |form_factor| is ff(s -> r) with both cosines and 1/pi, so that E_r = pi ff L_s is exact for
// uniform L_s. Where one end is a cluster, its cosine is left out: a cluster sends an intensity
// I(d) (W/sr) in place of ff's area and cosine, and receives a fluence (W/m2 facing the source)
// that its surfaces turn into irradiance with their own normals.
struct Link {
    NodeId source;
    float form_factor;
};

// All links of one receiver in one bin.
struct Segment {
    NodeId receiver;
    std::uint32_t begin, end;  // into LinkSet::links
    float inv_c;  // 1 / C(b), sr^-1: A_r(b) = Phi_r(b) inv_c (algorithm.md "J"); 0 for clusters
};

struct LinkSet {
    DirectionBins bins;
    std::vector<Link> links;  // sorted by bin, then receiver along the bin's axis, then source
    std::vector<Segment> segments;  // in the same order; front to back along the bin's axis
    std::vector<std::uint32_t> bin_segments;  // #bins + 1: segments of bin b are [b, b + 1)

    std::size_t radiance_count = 0;      // + links
    std::size_t antiradiance_count = 0;  // - links
    [[nodiscard]] std::size_t bytes() const;
};

}  // namespace antiradiance
