// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/antiradiance_table.h"

#include "base/parallel.h"
#include "solve/transport.h"

namespace antiradiance {

namespace {

// A sweep front to back solves A where occlusion has no cycles; two more settle the few that do.
constexpr int kSweeps = 3;

// One bin's antiradiance of all nodes from the Phi of its segments.
class BinPush {
public:
    BinPush(const PatchTree& tree, const LinkSet& links, std::span<const vec3> radiance,
            const vec3& most)
        : tree_(tree),
          links_(links),
          radiance_(radiance),
          most_(most),
          value_(tree.size()),
          area_(tree.size()) {}

    // phi: #segments. Writes value(n) into out[n * stride].
    void run(int bin, std::span<const vec3> phi, vec3* out, std::size_t stride) {
        const auto b = static_cast<std::size_t>(bin);
        const vec3 axis = links_.bins.axis(bin);
        value_.assign(tree_.size(), vec3(0));
        for (std::uint32_t i = links_.bin_segments[b]; i < links_.bin_segments[b + 1]; ++i) {
            const Segment& s = links_.segments[i];
            const auto n = static_cast<std::size_t>(s.receiver);
            value_[n] = tree_.is_cluster(s.receiver) ? phi[i] : phi[i] * s.inv_c;
        }
        // Down: a cluster hands its fluence on, a patch of it turns what it faces into radiance
        // (C is about the bin's solid angle times the cosine), patches hand theirs to children.
        for (std::size_t n = 1; n < tree_.size(); ++n) {
            const NodeId parent = tree_.parent[n];
            const auto p = static_cast<std::size_t>(parent);
            if (!tree_.is_cluster(parent) || tree_.is_cluster(static_cast<NodeId>(n))) {
                value_[n] += value_[p];
            } else if (glm::dot(axis, tree_.normal[n]) < 0) {
                value_[n] += value_[p] / links_.bins.mean_solid_angle();
            }
        }
        average_leaves();
        sum_clusters(axis);
        for (std::size_t n = 0; n < tree_.size(); ++n)
            out[n * stride] = value_[n];
    }

private:
    // Inner patches become the mean of their clamped leaves, clusters 0.
    void average_leaves() {
        area_.assign(tree_.size(), 0);
        for (std::size_t n = tree_.size(); n-- > 0;) {
            const auto id = static_cast<NodeId>(n);
            if (tree_.is_cluster(id)) {
                value_[n] = vec3(0);
                continue;
            }
            if (tree_.is_leaf(id)) {
                value_[n] = glm::clamp(value_[n], vec3(0), most_) * tree_.area[n];
                area_[n] = tree_.area[n];
            }
            // value_ holds the sum over leaves, weighted by area, until here.
            const NodeId parent = tree_.parent[n];
            if (!tree_.is_cluster(parent)) {
                const auto p = static_cast<std::size_t>(parent);
                if (area_[p] == 0) value_[p] = vec3(0);
                value_[p] += value_[n];
                area_[p] += area_[n];
            }
            value_[n] /= area_[n];
        }
    }

    // Clusters, which average_leaves() left at 0, become the sum over their surfaces.
    void sum_clusters(const vec3& axis) {
        for (const NodeId node : tree_.surface_node) {
            const auto n = static_cast<std::size_t>(node);
            const float facing = tree_.area[n] * glm::dot(axis, tree_.normal[n]);
            value_[static_cast<std::size_t>(tree_.parent[n])] -=
                facing > 0 ? facing * radiance_[n] : facing * value_[n];
        }
        for (std::size_t n = tree_.size(); n-- > 1;) {
            if (tree_.is_cluster(static_cast<NodeId>(n)))
                value_[static_cast<std::size_t>(tree_.parent[n])] += value_[n];
        }
    }

    const PatchTree& tree_;
    const LinkSet& links_;
    std::span<const vec3> radiance_;
    vec3 most_;
    std::vector<vec3> value_;
    std::vector<float> area_;
};

}  // namespace

AntiradianceTable antiradiance_table(const PatchTree& tree, const LinkSet& links,
                                     std::span<const vec3> radiance, Progress& progress) {
    Transport transport(tree, links);
    for (int i = 0; i < (links.antiradiance_count > 0 ? kSweeps : 1); ++i)
        transport.gather(radiance, Sweep::kFrontToBack, 1, progress);
    const std::span<const vec3> phi = transport.flux();
    vec3 most(0);
    for (const NodeId leaf : tree.leaves)
        most = glm::max(most, radiance[static_cast<std::size_t>(leaf)]);

    AntiradianceTable table;
    table.bins = links.bins.count();
    const auto bins = static_cast<std::size_t>(table.bins);
    table.values.resize(tree.size() * bins);
    constexpr std::size_t kBlock = 8;  // bins that share one BinPush
    parallel_for_blocks(bins, kBlock, progress, [&](std::size_t begin, std::size_t end) {
        BinPush push(tree, links, radiance, most);
        for (std::size_t b = begin; b < end; ++b) {
            progress.check();
            push.run(static_cast<int>(b), phi, table.values.data() + b, bins);
        }
    });
    return table;
}

}  // namespace antiradiance
