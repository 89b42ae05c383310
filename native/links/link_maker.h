// SPDX-License-Identifier: GPL-3.0-or-later
// The links of a pair of nodes that the oracle accepted: their form factors and direction bins.
#pragma once

#include "hierarchy/growing_tree.h"
#include "links/direction_bins.h"
#include "links/refine_oracle.h"

namespace antiradiance {

class LinkMaker {
public:
    // Borrows all; the tree may grow.
    LinkMaker(const GrowingTree& tree, const DirectionBins& bins, const RefineOptions& options)
        : tree_(tree), bins_(bins), options_(options) {}

    // Appends the links that the verdict asks for, and who shares the rays of their visibility.
    void link(NodeId a, NodeId b, const Verdict& verdict, RefinedLinks& out) const;

    // How many those are, if each goes through one bin and none turns out to carry nothing.
    [[nodiscard]] LinkCount count(NodeId a, NodeId b, const Verdict& verdict) const;

private:
    void add_links(NodeId source, NodeId receiver, bool minus, bool touching,
                   std::vector<RawLink>& out) const;
    void spread_over_bins(NodeId source, NodeId receiver, float ff, bool minus,
                          std::vector<RawLink>& out) const;

    const GrowingTree& tree_;
    const DirectionBins& bins_;
    const RefineOptions& options_;
};

}  // namespace antiradiance
