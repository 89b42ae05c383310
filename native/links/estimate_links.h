// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hierarchy/growing_tree.h"

namespace antiradiance {

// How many directed links a tree gets at least where no cluster may stand for its surfaces: one for
// each way that light, or antiradiance, can go between two surfaces. Quadratic in their number,
// from a sample of pairs; the tree has no patches below its surfaces yet, and refinement comes on
// top.
double estimate_links_without_clusters(const GrowingTree& surfaces_only);

}  // namespace antiradiance
