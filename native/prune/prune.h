// SPDX-License-Identifier: GPL-3.0-or-later
// Removes links that surfaces block: Mückl & Dachsbacher, section 4 ("Removing Occluded Links").
//
// A rule is a function and a row of the table in prune.cpp. Pruning is not neutral: where only some
// of the links of a bundle go, the antiradiance that is left takes back too much or too little
// (algorithm.md "Pruning").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "hierarchy/patch_tree.h"
#include "links/link_set.h"
#include "prune/link_visibility.h"
#include "prune/prune_options.h"
#include "scene/ray_scene.h"

namespace antiradiance {

// Which of the links that the conservative test finds blocked stay all the same.
enum class ConservativeKeeps {
    kBalanced,    // those without whose partners the balance of light and antiradiance would change
    kAlgorithm3,  // as after heuristic 2: more links go, and rooms get darker
};

struct PruneOptions {
    PruneMethod method = PruneMethod::kConservative;
    PruneDirections directions = PruneDirections::kStrict;  // of heuristic 1 and its oracle
    BlockingSides blocking_sides = BlockingSides::kAny;     // of - links; not for heuristic 1
    ConservativeKeeps conservative_keeps = ConservativeKeeps::kBalanced;
    int rays_per_link = 64;  // of the oracles, 1..
};

struct PruneInput {
    const Scene& scene;
    const PatchTree& tree;
    const LinkSet& links;  // of the IMPLICIT mode
    const RayScene& rays;  // read by the oracles alone
};

// #links, 1: to be removed.
using RemovedLinks = std::vector<std::uint8_t>;

struct PruneRule {
    PruneMethod method;
    const char* identifier;  // upper case, as Blender and the command line spell it
    const char* label;
    const char* description;
    bool traces_rays;
    RemovedLinks (*find)(const PruneInput& input, const PruneOptions& options, Progress& progress);
};

// All of them but kNone, in the order of the methods.
std::span<const PruneRule> prune_rules();

// The links that a rule removes, by their place in the set: for whoever compares rules.
RemovedLinks find_removed_links(const PruneInput& input, const PruneOptions& options,
                                Progress& progress);

// The set without them; segments that end up empty are dropped, 1/C stays as it is.
LinkSet remove_links(LinkSet links, std::span<const std::uint8_t> removed);

struct PruneResult {
    LinkSet links;
    std::size_t removed_radiance = 0;      // + links
    std::size_t removed_antiradiance = 0;  // - links
    double seconds = 0;                    // all of it, with the tables that rules need
};

// Deterministic. Throws Cancelled.
// Not for kNone.
PruneResult prune_links(const PruneInput& input, const PruneOptions& options, Progress& progress);

}  // namespace antiradiance
