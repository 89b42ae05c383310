// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/splatting.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace antiradiance {

namespace {

constexpr float kFootprint = 2;       // radius of a disk, in radii of its leaf
constexpr float kLeastCosine = 0.8F;  // between the normals of disk and fragment
constexpr float kMostHeight = 0.25F;  // of a fragment above the disk, in radii of the disk

class Splatter {
public:
    Splatter(const PatchTree& tree, std::span<const vec3> irradiance)
        : tree_(tree), irradiance_(irradiance) {}

    // Leaves whose disks can reach the group.
    void find(const FragmentGroup& group, std::vector<NodeId>& leaves) const {
        leaves.clear();
        for (NodeId node = 0; node < static_cast<NodeId>(tree_.size());) {
            const auto n = static_cast<std::size_t>(node);
            // A node's sphere holds its leaves; a leaf's disk is wider than it by its own radius.
            const float reach = kFootprint * tree_.radius[n] + group.radius;
            const vec3 d = tree_.center[n] - group.center;
            if (glm::dot(d, d) > reach * reach) {
                node = tree_.subtree_end[n];
                continue;
            }
            if (tree_.is_leaf(node) && !tree_.emits_only(node)) leaves.push_back(node);
            ++node;
        }
    }

    [[nodiscard]] vec3 irradiance(const Fragment& f, std::span<const NodeId> leaves) const {
        vec3 sum(0);
        float weights = 0;
        for (const NodeId leaf : leaves) {
            const auto n = static_cast<std::size_t>(leaf);
            const float w = weight(f, n);
            sum += w * irradiance_[n];
            weights += w;
        }
        if (weights > 0) return sum / weights;
        return f.leaf == kNone ? vec3(0) : irradiance_[static_cast<std::size_t>(f.leaf)];
    }

private:
    [[nodiscard]] float weight(const Fragment& f, std::size_t n) const {
        const float cosine = glm::dot(f.normal, tree_.normal[n]);
        if (cosine <= kLeastCosine) return 0;
        const vec3 d = f.position - tree_.center[n];
        const float radius = kFootprint * tree_.radius[n];
        const float share = glm::dot(d, d) / (radius * radius);
        if (share >= 1 || std::abs(glm::dot(d, tree_.normal[n])) > kMostHeight * radius) return 0;
        return (1 - share) * (1 - share) * (cosine - kLeastCosine) * tree_.exposed[n];
    }

    const PatchTree& tree_;
    std::span<const vec3> irradiance_;
};

}  // namespace

std::vector<vec3> splat(const PatchTree& tree, std::span<const vec3> irradiance,
                        const GBuffer& buffer, const FragmentGroups& groups, Progress& progress,
                        ProgressSpan span) {
    const Splatter splatter(tree, irradiance);
    std::vector<vec3> result(buffer.fragments.size(), vec3(0));
    parallel_for_blocks(
        groups.groups.size(), 16, progress,
        [&](std::size_t begin, std::size_t end) {
            std::vector<NodeId> leaves;
            for (std::size_t g = begin; g < end; ++g) {
                progress.check();
                const FragmentGroup& group = groups.groups[g];
                splatter.find(group, leaves);
                for (std::uint32_t i = group.begin; i < group.end; ++i) {
                    const std::uint32_t f = groups.order[i];
                    result[f] = splatter.irradiance(buffer.fragments[f], leaves);
                }
            }
        },
        span);
    return result;
}

}  // namespace antiradiance
