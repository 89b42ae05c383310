// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/row_normalisation.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/random.h"
#include "solve/cpu_solver.h"

namespace antiradiance {

namespace {

constexpr float kLeastScale = 0.6F;
constexpr float kMostScale = 1.5F;
constexpr int kFewRays = 32;    // settle a patch in a closed room, where all of them hit
constexpr int kManyRays = 256;  // where some escape

// Share of a leaf's cosine-weighted hemisphere that ends on surfaces.
float covered_share(const PatchTree& tree, const RayScene& rays, const BlockingPlanes& planes,
                    NodeId leaf) {
    const auto n = static_cast<std::size_t>(leaf);
    const std::uint16_t mask = tree.exposed_mask[n];
    if (mask == 0) return 0;
    const Frame frame(tree.normal[n]);
    const auto seed = static_cast<std::uint32_t>(2 * leaf);
    int hits = 0;
    int count = 0;
    int wanted = kFewRays;
    for (std::uint32_t i = 0; count < wanted; ++i) {
        const vec2 u = r2_sample(i, seed);
        const auto stratum = static_cast<unsigned>(u.y * 4) * 4 + static_cast<unsigned>(u.x * 4);
        if (!(mask >> stratum & 1U)) continue;
        const vec3 origin = tree.patch_point(leaf, u) + frame.n * (2 * rays.epsilon());
        const vec3 direction = frame.to_world(cosine_hemisphere(r2_sample(i, seed + 1)));
        const RayHit hit = rays.intersect(origin, direction);
        ++count;
        if (hit.hit() && planes.crossed(origin, origin + direction * hit.distance) == kNone) ++hits;
        if (count == kFewRays && hits < count) wanted = kManyRays;
    }
    return static_cast<float>(hits) / static_cast<float>(count);
}

}  // namespace

std::vector<float> row_scales(const PatchTree& tree, const LinkSet& links, const RowSubset& subset,
                              const RayScene& rays, const BlockingPlanes& planes,
                              Progress& progress) {
    std::vector<vec3> one(tree.size(), vec3(0));
    for (const NodeId leaf : tree.leaves) {
        if (!tree.emits_only(leaf))
            one[static_cast<std::size_t>(leaf)] =
                vec3(tree.exposed[static_cast<std::size_t>(leaf)]);
    }
    const std::vector<vec3> sums = gather_once(tree, links, one, subset.rows, progress);
    std::vector<float> scales(tree.size(), 1);
    parallel_for_blocks(tree.leaves.size(), 64, progress, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const NodeId leaf = tree.leaves[i];
            const auto n = static_cast<std::size_t>(leaf);
            const float sum = sums[n].x * kInvPi;
            const float share = subset.share.empty() ? 1.0F : subset.share[n];
            if (tree.emits_only(leaf) || sum <= 0 || share <= 0) continue;
            scales[n] = std::clamp(share * covered_share(tree, rays, planes, leaf) / sum,
                                   kLeastScale, kMostScale);
        }
    });
    return scales;
}

}  // namespace antiradiance
