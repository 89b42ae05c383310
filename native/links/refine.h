// SPDX-License-Identifier: GPL-3.0-or-later
// Link creation: refines pairs of nodes, splitting patches where needed, until the oracle accepts.
#pragma once

#include <vector>

#include "base/progress.h"
#include "hierarchy/growing_tree.h"
#include "links/blocking_planes.h"
#include "links/direction_bins.h"
#include "links/link_options.h"

namespace antiradiance {

struct RefineOptions {
    float link_threshold = 0.02F;  // eps: largest form factor of one link
    float bin_share = 1;           // k: largest solid angle of an end, in bins
    // Factor on eps for pairs with an emitter, 0..1: where links carry direct light, those few
    // carry most of it ("BF refinement", Hanrahan, Salzman & Aupperle 1991).
    float emitter_share = 1;
    int receiver_levels = 1;     // a link ends this many levels below the receiver that the oracle
                                 // accepted: finer shadows, less banding (Meyer et al. 2009)
    float least_edge = 0;        // m: patches whose longest edge is below are not split
    bool cluster_links = false;  // EXPLICIT only: far clusters link as one
    float cluster_floor =
        0.02F;                 // m: clusters with smaller radii are not refined against each other
    bool antiradiance = true;  // make - links
    // Touching links are spread over the bins that they cover also without - links, for who asks
    // for the direction of light between patches.
    bool spread_touching = false;
    std::size_t most_links = SIZE_MAX;  // stop with a SceneError beyond
    // Pairs that a plane parts are dropped before they are refined; null: there are none.
    const BlockingPlanes* planes = nullptr;
};

// A directed link before it is sorted; see Link.
struct RawLink {
    NodeId receiver;
    NodeId source;
    float form_factor;  // < 0: a - link
    std::uint16_t bin;
};

// Two nodes between which the + links [first, first + count) run, one way or both. One set of rays
// decides the visibility of all of them.
struct LinkedPair {
    NodeId a, b;
    std::uint32_t first;
    std::uint32_t count;
};

// + and - links.
struct LinkCount {
    std::size_t radiance = 0, antiradiance = 0;
    LinkCount& operator+=(const LinkCount& other) {
        radiance += other.radiance;
        antiradiance += other.antiradiance;
        return *this;
    }
    [[nodiscard]] std::size_t total() const { return radiance + antiradiance; }
};

// Two nodes all of whose links a plane would cut, and how many those are at least: between nodes
// as fine as other pairs have made them.
struct SeparatedPair {
    NodeId a, b;
    BlockerId plane;
    LinkCount links;
};

struct RefinedLinks {
    std::vector<RawLink> links;
    std::vector<LinkedPair> pairs;
    std::vector<SeparatedPair> separated;

    // number: node before -> node after, as GrowingTree::finish gives it.
    void renumber(const std::vector<NodeId>& number);
};

// Oracle (algorithm.md "Refinement oracle"): link when both form factors are below eps, both solid
// angles below k bins, the nodes are apart and neither straddles the other's plane; else split the
// larger one. Pairs that can't be split any further link all the same; where they touch, the link
// is spread over the bins that it covers ("Near field").
// Deterministic: the result does not depend on the number of threads.
RefinedLinks refine_links(GrowingTree& tree, const DirectionBins& bins,
                          const RefineOptions& options, Progress& progress);

}  // namespace antiradiance
