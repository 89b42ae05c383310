// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/blocker_cuts.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/stopwatch.h"
#include "links/cut_links.h"
#include "links/visibility.h"

namespace antiradiance {

namespace {

// Pairs of patches that are looked at, of each plane.
constexpr std::size_t kSamples = 1024;
constexpr std::uint32_t kMostTries = 8;  // at two patches of a parted pair that face each other
// Of the light's links that a plane cuts: how many may have a free way before it is told of.
constexpr double kFreeShare = 0.05;

// Of what a plane cuts, the share of the + links whose ends see each other: from every so many-th
// of them, as they come.
class FreeShare {
public:
    FreeShare(const PatchTree& tree, const RayScene& rays, std::size_t links)
        : tree_(tree), rays_(rays), stride_(1 + links / kSamples) {}

    void add_link(const RawLink& link) {
        if (count(1) == 0) return;
        // Clusters have no side that light arrives at.
        if (tree_.is_cluster(link.source) || tree_.is_cluster(link.receiver)) return;
        look(link.source, link.receiver);
    }
    void add_pair(const SeparatedPair& pair) {
        const std::size_t samples = count(pair.links.radiance);
        for (std::size_t i = 0; i < std::min(samples, kSamples); ++i) {
            for (std::uint32_t k = 0; k < kMostTries; ++k) {
                const auto seed = static_cast<std::uint32_t>(2 * (i * kMostTries + k));
                const NodeId a = leaf_below(pair.a, seed);
                const NodeId b = leaf_below(pair.b, seed + 1);
                if (!faces(a, b) || !faces(b, a)) continue;  // between these there is no link
                look(a, b);
                break;
            }
        }
    }
    [[nodiscard]] double share() const {
        return all_ > 0 ? static_cast<double>(free_) / static_cast<double>(all_) : 0;
    }

private:
    // How many samples fall into the next `links` of them.
    std::size_t count(std::size_t links) {
        const std::size_t before = seen_ / stride_;
        seen_ += links;
        return seen_ / stride_ - before;
    }
    void look(NodeId a, NodeId b) {
        ++all_;
        if (centers_see(tree_, rays_, a, b)) ++free_;
    }
    [[nodiscard]] bool faces(NodeId a, NodeId b) const {
        const auto n = static_cast<std::size_t>(a);
        return glm::dot(tree_.normal[n],
                        tree_.center[static_cast<std::size_t>(b)] - tree_.center[n]) > 0;
    }
    // One of the leaves of a subtree, by chance.
    [[nodiscard]] NodeId leaf_below(NodeId n, std::uint32_t seed) const {
        const auto begin = std::ranges::lower_bound(tree_.leaves, n);
        const auto end =
            std::ranges::lower_bound(tree_.leaves, tree_.subtree_end[static_cast<std::size_t>(n)]);
        const std::uint32_t chance = hash_combine(static_cast<std::uint32_t>(n), seed);
        return begin[static_cast<std::ptrdiff_t>(chance % static_cast<std::uint32_t>(end - begin))];
    }

    const PatchTree& tree_;
    const RayScene& rays_;
    std::size_t stride_;
    std::size_t seen_ = 0;
    std::size_t free_ = 0, all_ = 0;  // samples
};

// A plane in a wall takes away light that the wall stops anyhow; one in the open darkens the room.
std::vector<std::string> misplaced(const Scene& scene, const std::vector<FreeShare>& planes) {
    std::vector<std::string> warnings;
    for (std::size_t b = 0; b < planes.size(); ++b) {
        const double share = planes[b].share();
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
    for (std::size_t l = 0; l < crossed.size(); ++l) {
        const float form_factor = links.links[l].form_factor;
        if (crossed[l] == kNone || form_factor == 0) continue;
        LinkCount& plane = cuts.per_plane[static_cast<std::size_t>(crossed[l])];
        ++(form_factor > 0 ? plane.radiance : plane.antiradiance);
    }
    for (const SeparatedPair& pair : links.separated)
        cuts.per_plane[static_cast<std::size_t>(pair.plane)] += pair.links;
    progress.check();

    std::vector<FreeShare> shares;
    for (const LinkCount& plane : cuts.per_plane)
        shares.emplace_back(tree, rays, plane.radiance);
    for (std::size_t l = 0; l < crossed.size(); ++l) {
        RawLink& link = links.links[l];
        if (crossed[l] == kNone) continue;
        if (link.form_factor > 0) shares[static_cast<std::size_t>(crossed[l])].add_link(link);
        link.form_factor = 0;
    }
    for (const SeparatedPair& pair : links.separated)
        shares[static_cast<std::size_t>(pair.plane)].add_pair(pair);
    progress.check();
    cuts.warnings = misplaced(scene, shares);
    cuts.seconds = watch.lap();
    return cuts;
}

}  // namespace antiradiance
