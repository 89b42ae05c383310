// SPDX-License-Identifier: GPL-3.0-or-later
// Which patch lights light which fragments.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/progress.h"
#include "display/display_options.h"
#include "display/fragment_groups.h"
#include "hierarchy/patch_tree.h"
#include "links/blocking_planes.h"
#include "links/link_set.h"

namespace antiradiance {

struct SourceLists {
    std::vector<NodeId> sources;            // patches, ascending in each list
    std::vector<std::uint32_t> begin, end;  // of each group's list, into `sources`; #groups
    bool shared = false;                    // all groups have one list

    [[nodiscard]] std::span<const NodeId> of(std::size_t group) const {
        return {sources.data() + begin[group], end[group] - begin[group]};
    }
};

// A list for each group: select(group, list) appends to it, on any thread.
[[nodiscard]] SourceLists collect_lists(
    std::size_t group_count, Progress& progress,
    const std::function<void(std::size_t, std::vector<NodeId>&)>& select);

// One list for all groups: every leaf, or every parent of leaves (and leaves that are a whole
// surface), as in the paper's section 6.2.
[[nodiscard]] SourceLists all_sources(const PatchTree& tree, ShootingLevel level,
                                      std::size_t group_count);

struct CutRule {
    float threshold = 0.04F;   // sr, projected, at the group: larger nodes are refined
    bool fronts_only = false;  // leave out what turns its back on the group: it sends it no
                               // radiance, but antiradiance
};

// A cut through the tree for each group, of patches and clusters: nodes are replaced by their
// children while they look larger than the rule allows or are near (in the spirit of Walter et al.
// 2005, "Lightcuts", but with one bound on geometry instead of one on error).
[[nodiscard]] SourceLists cut_sources(const PatchTree& tree, const FragmentGroups& groups,
                                      const CutRule& rule, Progress& progress);

// Only what links connect to the groups' receiver or its ancestors (groups of one leaf each), for
// a link mesh that lost links: CUT starts at those sources and only descends, LEAVES takes the
// leaves below them.
[[nodiscard]] SourceLists linked_sources(const PatchTree& tree, const LinkSet& links,
                                         const GBuffer& buffer, const FragmentGroups& groups,
                                         ShootingLevel level, const CutRule& rule,
                                         Progress& progress);

// The groups' lists (groups of one leaf each) without what blocking planes part from their
// receiver, centre from centre as links are cut; a cluster that a plane may cut in two is replaced
// by what lies below it.
[[nodiscard]] SourceLists uncut_sources(const PatchTree& tree, const BlockingPlanes& planes,
                                        const GBuffer& buffer, const FragmentGroups& groups,
                                        const SourceLists& lists, Progress& progress);

struct NearAndFar {
    SourceLists near, far;
};

// Each group's list in two. What lies within a few of its own radii lights neighbouring pixels so
// differently that interleaving must not share it out among them: the thin parts of a model have
// fewer pixels than a block.
[[nodiscard]] NearAndFar split_near(const PatchTree& tree, const FragmentGroups& groups,
                                    const SourceLists& lists, Progress& progress);

}  // namespace antiradiance
