// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "base/progress.h"
#include "hierarchy/patch_tree.h"
#include "links/refine.h"
#include "scene/ray_scene.h"

namespace antiradiance {

class TestedPairs;
struct EarlierPairs;

// Points on the lit, exposed surface below a node, uniform by area.
class SurfaceSampler {
public:
    // weight: #nodes, read at leaves; below clusters, density is by area x weight. Empty: 1.
    explicit SurfaceSampler(const PatchTree& tree, std::span<const float> weight = {});

    struct Sample {
        vec3 point;
        vec3 normal;
    };
    // u: unit square; the whole square covers the node's exposed area once, as weighted.
    [[nodiscard]] Sample sample(NodeId node, const vec2& u) const;

private:
    [[nodiscard]] vec3 exposed_point(NodeId leaf, const vec2& u) const;

    const PatchTree& tree_;
    std::vector<std::int32_t> first_leaf_;  // #nodes + 1: leaves before this node in preorder
    std::vector<double> area_;              // #leaves + 1: exposed, weighted area of all before
};

// Rays that test a pair of nodes.
struct VisibilityRays {
    int per_pair = 4;
    // By what the links of the pair can carry, relative to the mean of all pairs: a quarter of
    // per_pair below .5, per_pair below 4, 9/4 of it above; the few pairs that carry most of the
    // light get most of the rays. Never by what rays have found: "more where the first two differ"
    // is biased.
    bool graded = false;
    // Links carry the light of emitters: pairs with one get four times per_pair, if graded.
    bool emitters_shine = false;
};

// Two nodes, the light that a link between them can carry (form factor times the receiver's area,
// m2, the larger of both ways), and how many rays test it.
struct TestedPair {
    NodeId a, b;
    double transfer = 0;
    int rays = 0;
};

// Light that a link can carry, m2. Of a cluster's surfaces a quarter of the area counts, the mean
// of what is seen of a convex body (Cauchy).
[[nodiscard]] double link_transfer(const PatchTree& tree, NodeId source, NodeId receiver,
                                   float form_factor);

// Sets `rays` of all pairs by their transfer; none for those that carry nothing. Returns the sum.
std::size_t count_rays(const PatchTree& tree, const VisibilityRays& rays,
                       std::span<TestedPair> pairs);

// The share of each pair's rays that nothing blocks, 0..1, whichever of its nodes comes first; 0
// without rays. Deterministic.
[[nodiscard]] std::vector<float> trace_pairs(const PatchTree& tree, const RayScene& scene,
                                             std::span<const TestedPair> pairs, Progress& progress);

// Whether nothing lies between the centres of two patches, each lifted off its surface.
[[nodiscard]] bool centers_see(const PatchTree& tree, const RayScene& scene, NodeId a, NodeId b);

// Pairs whose visibility is known are not tested again; what all pairs have is left behind.
struct KeptPairs {
    const EarlierPairs* earlier = nullptr;  // null: none is known
    TestedPairs* now = nullptr;             // null: nobody asks
};

// Multiplies the form factors of the pairs' + links by the pair's visibility; an occluded link gets
// 0. Pairs name nodes of `tree`. Returns the number of rays that were traced.
std::size_t apply_ray_visibility(const PatchTree& tree, const RayScene& scene,
                                 const VisibilityRays& rays, std::span<const LinkedPair> pairs,
                                 std::span<RawLink> links, Progress& progress,
                                 const KeptPairs& kept = {});

}  // namespace antiradiance
