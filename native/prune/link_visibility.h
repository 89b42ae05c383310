// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's heuristic 2: which links are blocked, and which of those must stay all the same.
#pragma once

#include <vector>

#include "base/progress.h"
#include "hierarchy/convex_regions.h"
#include "prune/link_index.h"
#include "prune/node_shapes.h"

namespace antiradiance {

enum class LinkVisibility : std::uint8_t { kFull, kPartial, kNone };

// Between what the blocking test runs.
enum class Shaft {
    kFromCenter,   // R's centre and S's corners, as algorithm 2 prints it
    kFromCorners,  // R's corners and S's: no segment between them is free
};

// What blocks a - link. It starts behind its source, inside of the solid that the source bounds.
enum class BlockingSides {
    kAny,  // as on + links, also those that the link leaves a solid through: where all light of
           // a bundle is blocked, its antiradiance goes as well (algorithm 2 tells no signs apart)
    kFacing,  // what light would meet: sides that face the source
};

struct ClassifyOptions {
    Shaft shaft = Shaft::kFromCorners;
    BlockingSides blocking_sides = BlockingSides::kAny;
};

// In place of a cluster's region.
inline constexpr RegionId kRegionsOfMembers = -2;

// What the blocking test knows of the scene.
struct Blockers {
    Blockers(const Scene& scene, const PatchTree& tree);

    struct Place {
        vec3 center;      // m
        RegionId region;  // kNone: blocks nothing
    };

    NodeShapes shapes;
    ConvexRegions regions;
    std::vector<Place> places;  // #nodes
};

// Algorithm 2 for all links, + and -. Candidates for O are the sources of links that end in the
// same bin at R, an ancestor or a child of R: on a mesh of several levels the links of one receiver
// are spread over them. A candidate stands for its whole convex region. Where S or O is a cluster,
// each surface of S must be blocked by one of O's; where R is one, its surfaces' corners count.
// (IMPLICIT renders make no links of clusters: RefineOptions::cluster_links.)
// #links. Deterministic.
std::vector<LinkVisibility> classify_links(const PatchTree& tree, const LinkSet& links,
                                           const Blockers& blockers, const ClassifyOptions& options,
                                           Progress& progress);

// Algorithm 3, reading "H2-b": 1 at the blocked links to remove. A blocked - link S' -> R stays
// where some S sends unblocked light to S' or an ancestor and part of it to R or its parent: the
// antiradiance of S' then takes back what S' hides of S from R (Fig. 6 d).
// Two readings: the light that arrives at S' counts in the - link's bin only, as J keeps the bin
// (Eq. 4), and it is + links whose partial occlusion calls for a - link.
// #links. Deterministic.
std::vector<std::uint8_t> blocked_and_not_required(const PatchTree& tree, const LinkSet& links,
                                                   const LinkIndex& index,
                                                   const std::vector<LinkVisibility>& visibility,
                                                   Progress& progress);

// In place of algorithm 3: 1 at the blocked links that may go without a change in balance. The
// antiradiance of X holds the light of all S that reach it; the - link X -> R takes it back from R,
// where S -> R brought it. So S -> R goes only if no such - link stays, and X -> R only if no such
// S still reaches X and R; S, X and R with the nodes above and below them, in one bin. What -
// links do across the border of two bins is not seen, so that the balance is kept for the most
// part. The largest such set, which is unique. No part of the paper: after algorithm 3 rooms get
// darker, as - links that are blocked in part take back light that is no longer sent.
// #links. Deterministic.
std::vector<std::uint8_t> blocked_and_balanced(const PatchTree& tree, const LinkSet& links,
                                               const std::vector<LinkVisibility>& visibility,
                                               Progress& progress);

}  // namespace antiradiance
