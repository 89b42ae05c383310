// SPDX-License-Identifier: GPL-3.0-or-later
// Link meshes without the pipeline's choices: which sides count and how they are refined is up to
// the test.
#pragma once

#include "links/build_link_set.h"
#include "links/refine.h"
#include "support/tree_builder.h"

namespace antiradiance::test {

struct LinkedScene {
    PatchTree tree;
    RefinedLinks refined;  // by node numbers of `tree`
    DirectionBins bins;

    // Links the fronts of all polygons, cut until no edge is longer than max_edge (m).
    LinkedScene(const Scene& scene, float max_edge, const RefineOptions& options,
                int bin_count = 128)
        : bins(bin_count) {
        GrowingTree growing(front_surfaces(scene));
        growing.split_to(max_edge);
        Progress progress;
        refined = refine_links(growing, bins, options, progress);
        std::vector<NodeId> number;
        tree = growing.finish(scene, number);
        refined.renumber(number);
    }

    [[nodiscard]] LinkSet sorted() const {
        Progress progress;
        return build_link_set(tree, bins, refined.links, progress);
    }
};

}  // namespace antiradiance::test
