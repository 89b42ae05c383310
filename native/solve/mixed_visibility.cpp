// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/mixed_visibility.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "links/link_pairs.h"
#include "prune/prune.h"
#include "solve/antiradiance_table.h"
#include "solve/row_normalisation.h"

namespace antiradiance {

namespace {

constexpr int kFirstBounces = 4;  // settle which units are bright
// Of light on + links in a unit's worth, beside light on - links: where no surface blocks any, rays
// only replace one exact answer by another. On an office and a corridor .4 errs least at small
// budgets; .2 and 1 err up to a third more there.
constexpr double kPlusWorth = 0.4;

// Light that a row receives, W of luminance.
struct RowLight {
    double plus = 0, minus = 0;
};

std::vector<RowLight> row_light(const PatchTree& tree, const LinkSet& links,
                                std::span<const vec3> radiance, Progress& progress) {
    const AntiradianceTable blocked = antiradiance_table(tree, links, radiance, progress);
    std::vector<RowLight> light(links.segments.size());
    parallel_for(static_cast<std::size_t>(links.bins.count()), progress, [&](std::size_t bin) {
        for (std::uint32_t s = links.bin_segments[bin]; s < links.bin_segments[bin + 1]; ++s) {
            const Segment& row = links.segments[s];
            const double area =
                static_cast<double>(tree.area[static_cast<std::size_t>(row.receiver)]);
            for (std::uint32_t l = row.begin; l < row.end; ++l) {
                const Link& link = links.links[l];
                const bool minus = link.form_factor < 0;
                const vec3 sent = minus ? blocked.of(link.source)[bin]
                                        : radiance[static_cast<std::size_t>(link.source)];
                (minus ? light[s].minus : light[s].plus) +=
                    area * static_cast<double>(kPi * std::abs(link.form_factor) * luminance(sent));
            }
        }
    });
    return light;
}

// The units of decision, in order of their bins.
struct Unit {
    NodeId top;
    std::uint32_t begin, end;  // into Units::rows
};
struct Units {
    std::vector<Unit> units;
    std::vector<std::uint32_t> rows;  // segments, unit by unit
};

Units find_units(const PatchTree& tree, const LinkSet& links) {
    Units result;
    result.rows.resize(links.segments.size());
    std::iota(result.rows.begin(), result.rows.end(), 0U);
    for (std::uint32_t bin = 0; bin + 1 < links.bin_segments.size(); ++bin) {
        const std::uint32_t begin = links.bin_segments[bin];
        const std::uint32_t end = links.bin_segments[bin + 1];
        std::sort(result.rows.begin() + begin, result.rows.begin() + end,
                  [&](std::uint32_t a, std::uint32_t b) {
                      return links.segments[a].receiver < links.segments[b].receiver;
                  });
        NodeId unit_end = 0;  // of the last unit's subtree
        for (std::uint32_t i = begin; i < end; ++i) {
            const NodeId receiver = links.segments[result.rows[i]].receiver;
            if (receiver >= unit_end) {
                result.units.push_back({receiver, i, i});
                unit_end = tree.subtree_end[static_cast<std::size_t>(receiver)];
            }
            result.units.back().end = i + 1;
        }
    }
    return result;
}

// Which units rays decide, within a budget.
class Choice {
public:
    Choice(const LinkSet& links, const Units& units, const LinkPairs& pairs)
        : links_(links), units_(units), pairs_(pairs), wanted_(pairs.pairs.size(), 0) {}

    // light: of rows. Returns #rows, 1: explicit.
    std::vector<std::uint8_t> choose(std::span<const RowLight> light, std::size_t most_rays) {
        struct Ranked {
            double worth;
            std::uint32_t unit;
        };
        std::vector<Ranked> ranked;
        for (std::uint32_t u = 0; u < units_.units.size(); ++u)
            ranked.push_back({worth_of(units_.units[u], light), u});
        std::sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
            return a.worth != b.worth ? a.worth > b.worth : a.unit < b.unit;
        });
        std::vector<std::uint8_t> is_explicit(links_.segments.size(), 0);
        if (most_rays == 0) return is_explicit;  // not even what - links alone make up
        for (const Ranked& r : ranked) {
            const Unit& unit = units_.units[r.unit];
            const std::size_t more = rays_for(unit);
            if (rays_ + more > most_rays) break;
            rays_ += more;
            for_links(unit, [&](std::uint32_t pair) { wanted_[pair] = 1; });
            for (std::uint32_t i = unit.begin; i < unit.end; ++i)
                is_explicit[units_.rows[i]] = 1;
        }
        return is_explicit;
    }
    [[nodiscard]] std::size_t rays() const { return rays_; }

    // Of all pairs; 0 for those that no explicit unit needs.
    [[nodiscard]] std::vector<float> trace(const PatchTree& tree, const RayScene& scene,
                                           Progress& progress) const {
        std::vector<TestedPair> tested = pairs_.pairs;
        for (std::size_t p = 0; p < tested.size(); ++p)
            tested[p].rays *= wanted_[p];
        return trace_pairs(tree, scene, tested, progress);
    }

private:
    template <typename Visit>
    void for_links(const Unit& unit, const Visit& visit) const {
        for (std::uint32_t i = unit.begin; i < unit.end; ++i) {
            const Segment& row = links_.segments[units_.rows[i]];
            for (std::uint32_t l = row.begin; l < row.end; ++l) {
                if (pairs_.of_link[l] != kNoPair) visit(pairs_.of_link[l]);
            }
        }
    }
    // Rays that no unit before has asked for. A pair's links may lie in two units, and in one
    // twice.
    [[nodiscard]] std::size_t rays_for(const Unit& unit) {
        std::size_t rays = 0;
        for_links(unit, [&](std::uint32_t pair) {
            if (wanted_[pair]) return;
            wanted_[pair] = 1;
            asked_.push_back(pair);
            rays += static_cast<std::size_t>(pairs_.pairs[pair].rays);
        });
        for (const std::uint32_t pair : asked_)
            wanted_[pair] = 0;
        asked_.clear();
        return rays;
    }
    [[nodiscard]] double worth_of(const Unit& unit, std::span<const RowLight> light) const {
        double worth = 0;
        for (std::uint32_t i = unit.begin; i < unit.end; ++i)
            worth += light[units_.rows[i]].minus + kPlusWorth * light[units_.rows[i]].plus;
        double rays = 1;
        for_links(unit, [&](std::uint32_t pair) {
            rays += static_cast<double>(pairs_.pairs[pair].rays);
        });
        return worth / rays;
    }

    const LinkSet& links_;
    const Units& units_;
    const LinkPairs& pairs_;
    std::vector<std::uint8_t> wanted_;  // #pairs
    std::vector<std::uint32_t> asked_;  // by the unit that is looked at
    std::size_t rays_ = 0;
};

// Preorder: parents come first.
void push_down(const PatchTree& tree, std::vector<double>& values) {
    for (std::size_t n = 1; n < tree.size(); ++n)
        values[n] += values[static_cast<std::size_t>(tree.parent[n])];
}

// The share of each node that is explicit, 0..1, by a measure of rows or units.
class ExplicitShare {
public:
    explicit ExplicitShare(std::size_t nodes) : part_(nodes, 0), whole_(nodes, 0) {}
    void add(NodeId node, double measure, bool is_explicit) {
        whole_[static_cast<std::size_t>(node)] += measure;
        if (is_explicit) part_[static_cast<std::size_t>(node)] += measure;
    }
    void push(const PatchTree& tree) {
        push_down(tree, part_);
        push_down(tree, whole_);
    }
    // Where nothing was measured: `otherwise`.
    [[nodiscard]] float of(std::size_t n, float otherwise) const {
        return whole_[n] > 0 ? static_cast<float>(part_[n] / whole_[n]) : otherwise;
    }

private:
    std::vector<double> part_, whole_;  // #nodes
};

// Row normalisation of explicit units only. A leaf's rows add up to the share of its hemisphere
// that surfaces cover, those of its explicit bins to their share of that, but only on average: the
// links of one bin reach into its neighbours. So the scale of few bins is trusted by the square of
// what they are of the hemisphere (by less or more the error rises between budgets), and applied by
// as much as they are of the leaf's light.
std::vector<float> mixed_row_scales(const PatchTree& tree, const LinkSet& links,
                                    const RayScene& scene, const BlockingPlanes& planes,
                                    const Units& units, std::span<const std::uint8_t> is_explicit,
                                    std::span<const RowLight> light, Progress& progress) {
    ExplicitShare of_hemisphere(tree.size());
    for (const Unit& unit : units.units) {
        const std::uint32_t row = units.rows[unit.begin];
        const float inv_c = links.segments[row].inv_c;
        if (inv_c > 0)
            of_hemisphere.add(unit.top, 1 / static_cast<double>(inv_c), is_explicit[row] != 0);
    }
    of_hemisphere.push(tree);
    ExplicitShare of_light(tree.size());
    for (std::size_t s = 0; s < links.segments.size(); ++s) {
        const NodeId receiver = links.segments[s].receiver;
        const double net = std::max(0.0, light[s].plus - light[s].minus);
        of_light.add(receiver,
                     net / static_cast<double>(tree.area[static_cast<std::size_t>(receiver)]),
                     is_explicit[s] != 0);
    }
    of_light.push(tree);

    std::vector<float> share(tree.size(), 0);
    for (std::size_t n = 0; n < tree.size(); ++n)
        share[n] = of_hemisphere.of(n, 0);
    std::vector<float> scales =
        row_scales(tree, links, {is_explicit, share}, scene, planes, progress);
    for (std::size_t n = 0; n < tree.size(); ++n)
        scales[n] = 1 + of_light.of(n, share[n]) * share[n] * share[n] * (scales[n] - 1);
    return scales;
}

}  // namespace

MixedVisibility mix_visibility(const TransportProblem& implicit, const RayScene& scene,
                               const BlockingPlanes& planes, const MixedOptions& options,
                               Progress& progress) {
    const PatchTree& tree = implicit.tree;
    MixedVisibility mixed;
    mixed.links = implicit.links;
    LinkSet& links = mixed.links;
    LinkPairs pairs = pair_links(tree, links);
    const std::size_t all_rays = count_rays(tree, options.rays, pairs.pairs);
    const Units units = find_units(tree, links);

    SolveOptions first;
    first.max_iterations = kFirstBounces;
    const Solution solution = make_cpu_solver()->solve(implicit, first, progress);
    const std::vector<RowLight> light = row_light(tree, links, solution.radiance, progress);

    Choice choice(links, units, pairs);
    const auto budget = static_cast<std::size_t>(
        std::llround(static_cast<double>(options.ray_budget) * static_cast<double>(all_rays)));
    const std::vector<std::uint8_t> is_explicit = choice.choose(light, budget);
    mixed.rays = choice.rays();
    const std::vector<float> visibility = choice.trace(tree, scene, progress);

    for (const std::uint8_t by_rays : is_explicit)
        ++(by_rays ? mixed.explicit_rows : mixed.implicit_rows);
    const RemovedLinks gone = weigh_links(links, pairs, visibility, is_explicit);
    mixed.row_scale =
        mixed_row_scales(tree, links, scene, planes, units, is_explicit, light, progress);
    mixed.links = remove_links(std::move(mixed.links), gone);
    return mixed;
}

}  // namespace antiradiance
