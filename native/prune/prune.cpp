// SPDX-License-Identifier: GPL-3.0-or-later
#include "prune/prune.h"

#include <algorithm>
#include <stdexcept>

#include "base/stopwatch.h"
#include "prune/heuristic_1.h"
#include "prune/link_visibility.h"
#include "prune/ray_visibility.h"

namespace antiradiance {

namespace {

std::vector<LinkVisibility> by_shafts(const PruneInput& in, const PruneOptions& options,
                                      Shaft shaft, Progress& progress) {
    const Blockers blockers(in.scene, in.tree);
    return classify_links(in.tree, in.links, blockers, {shaft, options.blocking_sides}, progress);
}

RemovedLinks algorithm_3(const PruneInput& in, const std::vector<LinkVisibility>& visibility,
                         Progress& progress) {
    const LinkIndex index(in.tree, in.links);
    return blocked_and_not_required(in.tree, in.links, index, visibility, progress);
}

RemovedLinks heuristic_1(const PruneInput& in, const PruneOptions& options, Progress& progress) {
    return find_blocked_triples(in.tree, in.links, options.directions, {}, progress);
}

RemovedLinks heuristic_2(const PruneInput& in, const PruneOptions& options, Progress& progress) {
    return algorithm_3(in, by_shafts(in, options, Shaft::kFromCenter, progress), progress);
}

RemovedLinks heuristic_2_then_1(const PruneInput& in, const PruneOptions& options,
                                Progress& progress) {
    RemovedLinks removed = heuristic_2(in, options, progress);
    const RemovedLinks more =
        find_blocked_triples(in.tree, in.links, options.directions, {.gone = removed}, progress);
    for (std::size_t l = 0; l < removed.size(); ++l)
        removed[l] |= more[l];
    return removed;
}

RemovedLinks conservative(const PruneInput& in, const PruneOptions& options, Progress& progress) {
    const std::vector<LinkVisibility> visibility =
        by_shafts(in, options, Shaft::kFromCorners, progress);
    return options.conservative_keeps == ConservativeKeeps::kBalanced
               ? blocked_and_balanced(in.tree, in.links, visibility, progress)
               : algorithm_3(in, visibility, progress);
}

std::vector<LinkVisibility> by_rays(const PruneInput& in, const PruneOptions& options,
                                    Progress& progress) {
    return trace_visibility(in.scene, in.tree, in.links, in.rays,
                            {options.rays_per_link, options.blocking_sides}, progress);
}

RemovedLinks oracle_1(const PruneInput& in, const PruneOptions& options, Progress& progress) {
    const std::vector<LinkVisibility> visibility = by_rays(in, options, progress);
    return find_blocked_triples(in.tree, in.links, options.directions, {.visibility = visibility},
                                progress);
}

RemovedLinks oracle_2(const PruneInput& in, const PruneOptions& options, Progress& progress) {
    return algorithm_3(in, by_rays(in, options, progress), progress);
}

constexpr PruneRule kRules[] = {
    {PruneMethod::kHeuristic1, "HEURISTIC_1", "Heuristic 1",
     "Remove a link, and the antiradiance that takes it back, where a patch in between fills the "
     "link's direction",
     false, &heuristic_1},
    {PruneMethod::kHeuristic2, "HEURISTIC_2", "Heuristic 2",
     "Remove links whose source is hidden from the middle of their receiver by one flat surface",
     false, &heuristic_2},
    {PruneMethod::kHeuristic2Then1, "HEURISTIC_2_THEN_1", "Heuristic 2, then 1",
     "Remove what heuristic 2 finds, then what heuristic 1 finds in the rest", false,
     &heuristic_2_then_1},
    {PruneMethod::kConservative, "CONSERVATIVE", "Conservative",
     "Remove links whose source is hidden from all of their receiver by one flat surface: no light "
     "that arrives is lost",
     false, &conservative},
    {PruneMethod::kOracle1, "ORACLE_1", "Heuristic 1 by rays",
     "Heuristic 1 with rays in place of its test, to compare it with", true, &oracle_1},
    {PruneMethod::kOracle2, "ORACLE_2", "Heuristic 2 by rays",
     "Heuristic 2 with rays in place of its test, to compare it with", true, &oracle_2},
};

}  // namespace

std::span<const PruneRule> prune_rules() {
    return kRules;
}

RemovedLinks find_removed_links(const PruneInput& input, const PruneOptions& options,
                                Progress& progress) {
    for (const PruneRule& rule : kRules) {
        if (rule.method == options.method) return rule.find(input, options, progress);
    }
    throw std::logic_error("a pruning method without a row in kRules");
}

LinkSet remove_links(LinkSet links, std::span<const std::uint8_t> removed) {
    LinkSet kept;
    kept.bins = std::move(links.bins);
    if (links.bin_segments.empty()) return kept;
    kept.bin_segments.push_back(0);
    std::uint32_t next = 0;
    std::size_t end_of_bin = 1;
    const auto end_bins = [&](std::size_t segment) {
        for (; end_of_bin < links.bin_segments.size() && links.bin_segments[end_of_bin] <= segment;
             ++end_of_bin)
            kept.bin_segments.push_back(static_cast<std::uint32_t>(kept.segments.size()));
    };
    for (std::size_t i = 0; i < links.segments.size(); ++i) {
        end_bins(i);
        Segment segment = links.segments[i];
        const std::uint32_t begin = next;
        for (std::uint32_t l = segment.begin; l < segment.end; ++l) {
            if (removed[l]) continue;
            const Link link = links.links[l];
            ++(link.form_factor > 0 ? kept.radiance_count : kept.antiradiance_count);
            links.links[next++] = link;
        }
        if (next == begin) continue;
        segment.begin = begin;
        segment.end = next;
        kept.segments.push_back(segment);
    }
    end_bins(links.segments.size());
    links.links.resize(next);
    links.links.shrink_to_fit();
    kept.links = std::move(links.links);
    return kept;
}

PruneResult prune_links(const PruneInput& input, const PruneOptions& options, Progress& progress) {
    Stopwatch watch;
    const RemovedLinks removed = find_removed_links(input, options, progress);
    PruneResult result;
    result.links = remove_links(input.links, removed);
    result.removed_radiance = input.links.radiance_count - result.links.radiance_count;
    result.removed_antiradiance = input.links.antiradiance_count - result.links.antiradiance_count;
    result.seconds = watch.lap();
    return result;
}

}  // namespace antiradiance
