// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/blocker_cuts.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/stopwatch.h"
#include "links/cut_links.h"

namespace antiradiance {

namespace {

// Pairs of patches that are looked at of each plane, and of a pair of nodes that it parts.
constexpr std::size_t kSamples = 1024;
constexpr std::uint32_t kSamplesOfPair = 16;
// Of the light's links that a plane cuts: how many may have a free way before it is told of.
constexpr double kFreeShare = 0.05;

// What a plane cuts: a + link, or two nodes that it parts and the number of + links between them.
struct Cut {
    NodeId a, b;
    std::size_t links;
    bool parted;
};

// The share of the + links of a plane whose ends see each other.
class FreeShare {
public:
    FreeShare(const PatchTree& tree, const RayScene& rays, const BlockingPlanes& planes)
        : tree_(tree), rays_(rays), planes_(planes) {}

    [[nodiscard]] double operator()(const std::vector<Cut>& cuts) const {
        const std::size_t stride = 1 + cuts.size() / kSamples;
        double free = 0;
        double all = 0;
        for (std::size_t i = 0; i < cuts.size(); i += stride)
            add(cuts[i], free, all);
        return all > 0 ? free / all : 0;
    }

private:
    void add(const Cut& cut, double& free, double& all) const {
        const std::uint32_t count = cut.parted ? kSamplesOfPair : 1;
        const double weight = static_cast<double>(cut.links) / count;
        for (std::uint32_t i = 0; i < count; ++i) {
            const NodeId a = end_of(cut.a, cut.parted, 2 * i);
            const NodeId b = end_of(cut.b, cut.parted, 2 * i + 1);
            const vec3 from = lifted(a);
            const vec3 to = lifted(b);
            const bool linked =
                glm::dot(normal(a), to - from) > 0 && glm::dot(normal(b), from - to) > 0;
            if (!linked || planes_.crossed(from, to) == kNone) continue;
            all += weight;
            if (!rays_.occluded(from, to)) free += weight;
        }
    }

    // The patch that a link ends at, or one of the leaves below a parted node, by chance.
    [[nodiscard]] NodeId end_of(NodeId n, bool parted, std::uint32_t seed) const {
        if (!parted && !tree_.is_cluster(n)) return n;
        const auto begin = std::ranges::lower_bound(tree_.leaves, n);
        const auto end =
            std::ranges::lower_bound(tree_.leaves, tree_.subtree_end[static_cast<std::size_t>(n)]);
        const std::uint32_t chance = hash_combine(static_cast<std::uint32_t>(n), seed);
        return begin[static_cast<std::ptrdiff_t>(chance % static_cast<std::uint32_t>(end - begin))];
    }
    [[nodiscard]] const vec3& normal(NodeId n) const {
        return tree_.normal[static_cast<std::size_t>(n)];
    }
    [[nodiscard]] vec3 lifted(NodeId n) const {
        return tree_.center[static_cast<std::size_t>(n)] + normal(n) * (2 * rays_.epsilon());
    }

    const PatchTree& tree_;
    const RayScene& rays_;
    const BlockingPlanes& planes_;
};

// A plane in a wall takes away light that the wall stops anyhow; one in the open darkens the room.
std::vector<std::string> misplaced(const Scene& scene, const FreeShare& free_share,
                                   const std::vector<std::vector<Cut>>& cuts) {
    std::vector<std::string> warnings;
    for (std::size_t b = 0; b < cuts.size(); ++b) {
        const double share = free_share(cuts[b]);
        if (share < kFreeShare) continue;
        warnings.push_back(
            "Blocking plane '" + scene.blockers[b].name + "': no wall is in the way of " +
            std::to_string(std::lround(100 * share)) +
            " % of the light's links that it cuts, so that it darkens what should be lit; move it "
            "into a wall, or make it no larger than the wall");
    }
    return warnings;
}

}  // namespace

BlockerCuts cut_by_blockers(const Scene& scene, const PatchTree& tree, const RayScene& rays,
                            const BlockingPlanes& planes, RefinedLinks& links, Progress& progress) {
    BlockerCuts cuts;
    cuts.per_plane.resize(scene.blockers.size());
    if (planes.empty()) return cuts;
    Stopwatch watch;
    const std::vector<BlockerId> crossed = find_cut_links(tree, links.links, planes, progress);
    std::vector<std::vector<Cut>> lights(scene.blockers.size());  // #planes, + links
    for (std::size_t l = 0; l < crossed.size(); ++l) {
        RawLink& link = links.links[l];
        if (crossed[l] == kNone || link.form_factor == 0) continue;
        const auto plane = static_cast<std::size_t>(crossed[l]);
        if (link.form_factor > 0) {
            ++cuts.per_plane[plane].radiance;
            lights[plane].push_back({link.source, link.receiver, 1, false});
        } else {
            ++cuts.per_plane[plane].antiradiance;
        }
        link.form_factor = 0;
    }
    for (const SeparatedPair& pair : links.separated) {
        const auto plane = static_cast<std::size_t>(pair.plane);
        cuts.per_plane[plane] += pair.links;
        lights[plane].push_back({pair.a, pair.b, pair.links.radiance, true});
    }
    cuts.seconds = watch.lap();
    cuts.warnings = misplaced(scene, FreeShare(tree, rays, planes), lights);
    return cuts;
}

}  // namespace antiradiance
