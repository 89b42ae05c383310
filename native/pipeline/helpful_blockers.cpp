// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/helpful_blockers.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "hierarchy/push_pull.h"
#include "solve/antiradiance_table.h"

namespace antiradiance {

namespace {

constexpr int kMostRounds = 4;  // a plane may help only when another is there

// What a link that planes cross brings to its receiver.
struct Brought {
    NodeId receiver;
    float irradiance;  // W/m2, luminance; < 0: antiradiance
    bool cut;          // by a plane that is in
};

class Choice {
public:
    Choice(const PatchTree& tree, std::span<const vec3> error) : tree_(tree), left_(tree.size()) {
        for (const NodeId leaf : tree.leaves)
            left_[static_cast<std::size_t>(leaf)] =
                static_cast<double>(luminance(error[static_cast<std::size_t>(leaf)]));
    }

    void add_links(const LinkSet& links, const BlockingPlanes& planes, std::size_t plane_count,
                   std::span<const BlockerId> cut, std::span<const vec3> radiance,
                   Progress& progress) {
        const AntiradianceTable blocked = antiradiance_table(tree_, links, radiance, progress);
        crossing_.resize(plane_count);
        std::vector<BlockerId> crossed;
        for (std::size_t bin = 0; bin + 1 < links.bin_segments.size(); ++bin) {
            progress.check();
            for (std::uint32_t s = links.bin_segments[bin]; s < links.bin_segments[bin + 1]; ++s) {
                const Segment& row = links.segments[s];
                for (std::uint32_t l = row.begin; l < row.end; ++l) {
                    if (cut[l] == kNone) continue;
                    const Link& link = links.links[l];
                    const auto source = static_cast<std::size_t>(link.source);
                    const vec3 sent =
                        link.form_factor < 0 ? blocked.of(link.source)[bin] : radiance[source];
                    planes.all_crossed(tree_.center[source],
                                       tree_.center[static_cast<std::size_t>(row.receiver)],
                                       crossed);
                    for (const BlockerId plane : crossed)
                        crossing_[static_cast<std::size_t>(plane)].push_back(
                            static_cast<std::uint32_t>(brought_.size()));
                    brought_.push_back(
                        {row.receiver, kPi * link.form_factor * luminance(sent), false});
                }
            }
        }
    }

    // #planes
    [[nodiscard]] std::vector<std::uint8_t> choose(Progress& progress) {
        std::vector<std::size_t> order(crossing_.size());
        std::iota(order.begin(), order.end(), 0U);
        std::ranges::stable_sort(order, std::greater{},
                                 [&](std::size_t p) { return crossing_[p].size(); });
        std::vector<std::uint8_t> helps(crossing_.size(), 0);
        for (int round = 0; round < kMostRounds; ++round) {
            const std::vector<std::uint8_t> before = helps;
            for (const std::size_t plane : order) {
                progress.check();
                if (!helps[plane] && take(plane)) helps[plane] = 1;
            }
            if (helps == before) break;
        }
        return helps;
    }

private:
    // Lets a plane in if the sum of squares, by area, falls.
    bool take(std::size_t plane) {
        std::vector<double> change(tree_.size(), 0);
        for (const std::uint32_t i : crossing_[plane]) {
            const Brought& link = brought_[i];
            if (!link.cut)
                change[static_cast<std::size_t>(link.receiver)] -=
                    static_cast<double>(link.irradiance);
        }
        push_sum<double>(tree_, change);
        double gain = 0;
        for (const NodeId leaf : tree_.leaves) {
            const auto n = static_cast<std::size_t>(leaf);
            gain += static_cast<double>(tree_.area[n] * tree_.exposed[n]) *
                    (2 * left_[n] + change[n]) * change[n];
        }
        if (gain >= 0) return false;
        for (const NodeId leaf : tree_.leaves)
            left_[static_cast<std::size_t>(leaf)] += change[static_cast<std::size_t>(leaf)];
        for (const std::uint32_t i : crossing_[plane])
            brought_[i].cut = true;
        return true;
    }

    const PatchTree& tree_;
    std::vector<double> left_;  // #nodes: the error beside the planes that are in, at leaves
    std::vector<Brought> brought_;
    std::vector<std::vector<std::uint32_t>> crossing_;  // #planes, into brought_
};

}  // namespace

std::vector<std::uint8_t> find_helpful_blockers(const PatchTree& tree, const LinkSet& links,
                                                const BlockingPlanes& planes,
                                                std::size_t plane_count,
                                                std::span<const BlockerId> cut,
                                                std::span<const vec3> radiance,
                                                std::span<const vec3> error, Progress& progress) {
    Choice choice(tree, error);
    choice.add_links(links, planes, plane_count, cut, radiance, progress);
    return choice.choose(progress);
}

}  // namespace antiradiance
