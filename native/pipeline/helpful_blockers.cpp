// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/helpful_blockers.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hierarchy/push_pull.h"
#include "solve/antiradiance_table.h"

namespace antiradiance {

namespace {

constexpr int kMostRounds = 8;  // of second thoughts

// W/m2 by which each plane changes the irradiance of the leaves, luminance.  // #planes x #nodes
std::vector<std::vector<double>> changes(const PatchTree& tree, const LinkSet& links,
                                         std::span<const BlockerId> cut, std::size_t plane_count,
                                         std::span<const vec3> radiance, Progress& progress) {
    const AntiradianceTable blocked = antiradiance_table(tree, links, radiance, progress);
    std::vector<std::vector<double>> change(plane_count, std::vector<double>(tree.size(), 0));
    for (std::size_t bin = 0; bin + 1 < links.bin_segments.size(); ++bin) {
        for (std::uint32_t s = links.bin_segments[bin]; s < links.bin_segments[bin + 1]; ++s) {
            const Segment& row = links.segments[s];
            for (std::uint32_t l = row.begin; l < row.end; ++l) {
                if (cut[l] == kNone) continue;
                const Link& link = links.links[l];
                const vec3 sent = link.form_factor < 0
                                      ? blocked.of(link.source)[bin]
                                      : radiance[static_cast<std::size_t>(link.source)];
                change[static_cast<std::size_t>(cut[l])][static_cast<std::size_t>(row.receiver)] -=
                    static_cast<double>(kPi * link.form_factor * luminance(sent));
            }
        }
    }
    for (std::vector<double>& of_plane : change)
        push_sum<double>(tree, of_plane);
    return change;
}

}  // namespace

std::vector<std::uint8_t> find_helpful_blockers(const PatchTree& tree, const LinkSet& links,
                                                std::span<const BlockerId> cut,
                                                std::size_t plane_count,
                                                std::span<const vec3> radiance,
                                                std::span<const vec3> error, Progress& progress) {
    const std::vector<std::vector<double>> change =
        changes(tree, links, cut, plane_count, radiance, progress);
    std::vector<double> left(tree.size(), 0);  // of the error, beside the planes that are in
    for (const NodeId leaf : tree.leaves)
        left[static_cast<std::size_t>(leaf)] =
            static_cast<double>(luminance(error[static_cast<std::size_t>(leaf)]));

    // What the sum of squares gains, by area, when a plane's change comes in (sign 1) or goes.
    const auto gain = [&](std::size_t plane, double sign) {
        double sum = 0;
        for (const NodeId leaf : tree.leaves) {
            const auto n = static_cast<std::size_t>(leaf);
            const double c = sign * change[plane][n];
            sum += static_cast<double>(tree.area[n] * tree.exposed[n]) * (2 * left[n] + c) * c;
        }
        return sum;
    };
    std::vector<std::size_t> links_cut(plane_count, 0);
    for (const BlockerId plane : cut) {
        if (plane != kNone) ++links_cut[static_cast<std::size_t>(plane)];
    }
    std::vector<std::size_t> order(plane_count);
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t p) { return links_cut[p]; });

    std::vector<std::uint8_t> helps(plane_count, 0);
    for (int round = 0; round < kMostRounds; ++round) {
        bool any = false;
        for (const std::size_t plane : order) {
            const double sign = helps[plane] ? -1 : 1;
            if (links_cut[plane] == 0 || gain(plane, sign) >= 0) continue;
            for (const NodeId leaf : tree.leaves) {
                const auto n = static_cast<std::size_t>(leaf);
                left[n] += sign * change[plane][n];
            }
            helps[plane] = helps[plane] ? 0 : 1;
            any = true;
        }
        if (!any) break;
    }
    return helps;
}

}  // namespace antiradiance
