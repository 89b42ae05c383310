// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/splatting.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "display/display_layout_gl.h"

namespace antiradiance {

namespace {

using glsl::kFootprint;
using glsl::kLeastDiskCosine;
using glsl::kMostDiskHeight;

float disk_weight(const PatchTree& tree, const Fragment& f, std::size_t n) {
    const float cosine = glm::dot(f.normal, tree.normal[n]);
    if (cosine <= kLeastDiskCosine) return 0;
    const vec3 d = f.position - tree.center[n];
    const float radius = kFootprint * tree.radius[n];
    const float share = glm::dot(d, d) / (radius * radius);
    if (share >= 1 || std::abs(glm::dot(d, tree.normal[n])) > kMostDiskHeight * radius) return 0;
    return (1 - share) * (1 - share) * (cosine - kLeastDiskCosine) * tree.exposed[n];
}

vec3 splat_fragment(const SplattingInput& input, const Fragment& f,
                    std::span<const NodeId> leaves) {
    vec3 sum(0);
    float weights = 0;
    for (const NodeId leaf : leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        const float w = disk_weight(input.tree, f, n);
        sum += w * input.irradiance[n];
        weights += w;
    }
    return splatted_mean(input, f, sum, weights);
}

}  // namespace

SourceLists find_disks(const PatchTree& tree, const FragmentGroups& groups, Progress& progress) {
    const auto select = [&](std::size_t g, std::vector<NodeId>& leaves) {
        const FragmentGroup& group = groups.groups[g];
        for (NodeId node = 0; node < static_cast<NodeId>(tree.size());) {
            const auto n = static_cast<std::size_t>(node);
            // A node's sphere holds its leaves; a leaf's disk is wider than it by its own radius.
            const float reach = kFootprint * tree.radius[n] + group.radius;
            const vec3 d = tree.center[n] - group.center;
            if (glm::dot(d, d) > reach * reach) {
                node = tree.subtree_end[n];
                continue;
            }
            if (tree.is_leaf(node) && !tree.emits_only(node)) leaves.push_back(node);
            ++node;
        }
    };
    return collect_lists(groups.groups.size(), progress, select);
}

vec3 splatted_mean(const SplattingInput& input, const Fragment& fragment, const vec3& weighted_sum,
                   float weights) {
    if (weights > 0) return weighted_sum / weights;
    if (fragment.leaf == kNone) return vec3(0);
    return input.irradiance[static_cast<std::size_t>(fragment.leaf)];
}

std::vector<vec3> splat(const SplattingInput& input, Progress& progress, ProgressSpan span) {
    std::vector<vec3> result(input.buffer.fragments.size(), vec3(0));
    parallel_for_blocks(
        input.groups.groups.size(), 16, progress,
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t g = begin; g < end; ++g) {
                progress.check();
                const FragmentGroup& group = input.groups.groups[g];
                for (std::uint32_t i = group.begin; i < group.end; ++i) {
                    const std::uint32_t f = input.groups.order[i];
                    result[f] = splat_fragment(input, input.buffer.fragments[f], input.disks.of(g));
                }
            }
        },
        span);
    return result;
}

}  // namespace antiradiance
