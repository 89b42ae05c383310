// SPDX-License-Identifier: GPL-3.0-or-later
// Whether two nodes are linked as they are, and if not, which of them is refined.
#pragma once

#include "hierarchy/growing_tree.h"
#include "links/direction_bins.h"
#include "links/pair_geometry.h"
#include "links/refine.h"

namespace antiradiance {

// Which links run from one end to the other: + where the receiver lies in front of the source, -
// where it lies behind; both where it straddles the source's plane.
struct LinkSigns {
    bool plus = false;
    bool minus = false;
    [[nodiscard]] bool any() const { return plus || minus; }
};

struct Verdict {
    enum { kDrop, kLink, kSplitA, kSplitB } action = kDrop;
    LinkSigns to_b;  // a -> b
    LinkSigns to_a;  // b -> a
    bool touching = false;
};

// See refine_links().
class RefineOracle {
public:
    // Borrows the tree and the options; the tree may grow.
    RefineOracle(const GrowingTree& tree, const DirectionBins& bins, const RefineOptions& options);

    // Of two nodes neither of which lies below the other. To split a leaf means to give it
    // children.
    [[nodiscard]] Verdict decide(NodeId a, NodeId b) const;

private:
    [[nodiscard]] Verdict decide_patches(const GrowingNode& a, const GrowingNode& b) const;
    // whole: neither is a cluster that a plane may cut in two.
    [[nodiscard]] Verdict decide_clusters(const GrowingNode& a, const GrowingNode& b,
                                          bool whole) const;
    [[nodiscard]] LinkSigns signs(const GrowingNode& source, const GrowingNode& receiver,
                                  PlaneSide source_at, PlaneSide receiver_at) const;
    [[nodiscard]] bool can_split(const GrowingNode& n) const;
    [[nodiscard]] bool split_larger(const GrowingNode& a, const GrowingNode& b, Verdict& v) const;
    [[nodiscard]] bool small_enough(const GrowingNode& a, const GrowingNode& b, const vec3& d,
                                    float d2, bool straddles) const;
    [[nodiscard]] bool clusters_are_far(const GrowingNode& a, const GrowingNode& b) const;
    [[nodiscard]] bool may_be_cut_in_two(NodeId n) const;
    [[nodiscard]] bool emits(const GrowingNode& patch) const;
    [[nodiscard]] bool negligible(float exchange, float smaller_area, float eps) const;
    [[nodiscard]] bool both_negligible(const GrowingNode& a, const GrowingNode& b) const;
    [[nodiscard]] float least_area() const { return options_.least_edge * options_.least_edge; }

    const GrowingTree& tree_;
    const RefineOptions& options_;
    float widest_;  // sr
    // #nodes at first, all clusters among them: those that lie on both sides of a plane.
    std::vector<std::uint8_t> cut_in_two_;
};

}  // namespace antiradiance
