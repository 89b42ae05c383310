// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace antiradiance {

// How the visibility between two nodes enters the transport.
enum class Visibility {
    kImplicit,  // unoccluded + links; - links carry the light that a surface blocks (Eq. 3, 4)
    kExplicit,  // + links weighted by rays, no - links: hierarchical radiosity (operator G)
    kMixed,     // some rows of links explicit, the others implicit (Eq. 7)
    kDiscrete,  // the shortest + link of each row, no - links (Dong et al. 2007)
};

}  // namespace antiradiance
