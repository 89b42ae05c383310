// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "base/progress.h"
#include "hierarchy/patch_tree.h"
#include "links/refine.h"
#include "scene/ray_scene.h"

namespace antiradiance {

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

// Multiplies the form factors of the pairs' + links by the share of `rays_per_pair` segments
// between the two ends that nothing blocks; an occluded link gets 0. Pairs name nodes of `tree`.
// Deterministic.
void apply_ray_visibility(const PatchTree& tree, const RayScene& rays, int rays_per_pair,
                          std::span<const LinkedPair> pairs, std::span<RawLink> links,
                          Progress& progress);

}  // namespace antiradiance
