// SPDX-License-Identifier: GPL-3.0-or-later
// One pass of light over the link mesh on the CPU; the solvers are loops around it.
//
// Per bin: gather every segment's Phi (in parallel over bins: J keeps the bin, so for fixed L the
// antiradiance of one bin depends on that bin alone), then push Phi down and pull L up over the
// tree.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "hierarchy/patch_tree.h"
#include "links/link_set.h"
#include "solve/moments.h"

namespace antiradiance {

// Four floats that the compiler keeps in one register (a GCC and Clang extension).
using Float4 [[gnu::vector_size(16)]] = float;

enum class Sweep {
    kJacobi,       // A of this pass from A of the last one, as the paper prints it
    kFrontToBack,  // A in place, receivers in order along the bin's axis: one pass solves A where
                   // occlusion has no cycles
};

class Transport {
public:
    Transport(const PatchTree& tree, const LinkSet& links);

    // Phi of all segments, kept inside; reads radiance (#nodes, pulled) and the last pass's Phi.
    // damping: weight of the new Phi against the old, 0..1.
    void gather(std::span<const vec3> radiance, Sweep sweep, float damping, Progress& progress);

    // Phi of the last gather, W/m2.  // #segments
    [[nodiscard]] std::span<const vec3> flux() const { return phi_; }

    // Irradiance of all leaves from the last gather, W/m2.  // #nodes, 0 at inner nodes
    // rows: #segments, 1: takes part; empty: all.
    [[nodiscard]] std::vector<vec3> leaf_irradiance(std::span<const std::uint8_t> rows = {}) const;

    // Kept beside the tree and the links, but for what each node takes.
    [[nodiscard]] std::size_t bytes() const;

private:
    // A node whose antiradiance - links of a bin read.
    struct Passing {
        NodeId node;
        std::uint32_t first_use;  // segment whose links read it first
    };
    // A patch's place in the hierarchy, in one piece.
    struct Branch {
        NodeId parent;  // kNone: that is a cluster
        NodeId subtree_end;
        float area;  // m2
    };
    struct Scratch;

    void index_links();
    void gather_bin(int bin, Sweep sweep, float damping, Scratch& scratch);
    void load_clusters(int bin, Scratch& scratch) const;
    void load_antiradiance(NodeId node, Scratch& scratch) const;
    void push_moments(std::vector<Moments>& received, std::vector<vec3>& irradiance) const;

    const PatchTree& tree_;
    const LinkSet& links_;
    std::vector<Float4> radiance_;            // #nodes, of this pass
    Float4 most_antiradiance_{};              // upper clamp of A: the largest L of each colour
    std::vector<vec3> phi_;                   // #segments, W/m2
    std::vector<Branch> branches_;            // #nodes
    std::vector<Passing> passing_;            // by bin, then by first use
    std::vector<std::uint32_t> bin_passing_;  // #bins + 1
    // Clusters, only where links end at some:
    bool clusters_send_ = false;
    bool clusters_receive_ = false;
    std::vector<Moments> sent_;                      // #nodes if clusters_send_, read at clusters
    std::vector<std::vector<NodeId>> bin_clusters_;  // #bins: clusters that send into it
};

}  // namespace antiradiance
