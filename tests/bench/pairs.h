// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "links/link_set.h"
#include "links/refine.h"

namespace antiradiance::bench {

// Every + link of an implicit mesh, each with rays of its own.
struct Pairs {
    std::vector<RawLink> links;
    std::vector<LinkedPair> pairs;
};
Pairs all_pairs(const LinkSet& set);

}  // namespace antiradiance::bench
