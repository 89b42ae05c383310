// SPDX-License-Identifier: GPL-3.0-or-later
// Link creation and visibility.
#include <benchmark/benchmark.h>

#include "hierarchy/lit_sides.h"
#include "links/build_link_set.h"
#include "links/refine.h"
#include "links/visibility.h"
#include "meter.h"
#include "pairs.h"
#include "stages.h"

namespace antiradiance::bench {

namespace {

// Written once by refinement and once by each of the two sorting steps, which read it as well.
constexpr double kBytesPerMadeLink = 2.0 * sizeof(RawLink) + 4.0 * sizeof(Link);

GrowingTree unlinked_tree(const Stages& room) {
    Progress progress;
    const std::vector<Polygon> polygons = make_polygons(room.scene);
    const auto lit = find_lit_sides(room.scene, room.model.rays, polygons, progress);
    std::vector<Surface> surfaces;
    for (std::size_t p = 0; p < polygons.size(); ++p) {
        for (const bool back_side : {false, true}) {
            if (lit[p][back_side ? 1 : 0])
                surfaces.push_back(make_surface(room.scene, polygons[p], back_side));
        }
    }
    GrowingTree tree(std::move(surfaces));
    tree.split_to(room.options.max_patch_size);
    return tree;
}

// Refinement, form factors and sorting.
void link_creation(benchmark::State& state, Visibility visibility) {
    const Stages& room = stages(visibility);
    const GrowingTree unlinked = unlinked_tree(room);
    const DirectionBins& bins = room.model.links.bins;
    RefineOptions options;
    options.link_threshold = room.options.link_threshold;
    options.bin_share =
        static_cast<float>(bins.count()) / static_cast<float>(room.options.direction_bins);
    options.least_edge = 0.5F * room.options.max_patch_size;
    options.antiradiance = visibility == Visibility::kImplicit;
    Meter meter(state);
    std::size_t links = 0;
    for (auto _ : state) {
        Progress progress;
        GrowingTree growing = unlinked;
        RefinedLinks refined;
        meter.time([&] { refined = refine_links(growing, bins, options, progress); });
        std::vector<NodeId> number;
        const PatchTree tree = growing.finish(room.scene, number);
        for (RawLink& l : refined.links) {
            l.receiver = number[static_cast<std::size_t>(l.receiver)];
            l.source = number[static_cast<std::size_t>(l.source)];
        }
        meter.time(
            [&] { benchmark::DoNotOptimize(build_link_set(tree, bins, refined.links, progress)); });
        links = refined.links.size();
    }
    state.counters["links"] = static_cast<double>(links);
    state.counters["leaves"] = static_cast<double>(room.model.tree.leaves.size());
    meter.report("links", static_cast<double>(links), kBytesPerMadeLink);
}
BENCHMARK_CAPTURE(link_creation, IMPLICIT, Visibility::kImplicit)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(link_creation, EXPLICIT, Visibility::kExplicit)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

void visibility_rays(benchmark::State& state) {
    const Stages& room = stages(Visibility::kImplicit);
    Pairs all = all_pairs(room.model.links);
    const int rays_per_pair = room.options.visibility_rays;
    Meter meter(state);
    for (auto _ : state) {
        Progress progress;
        meter.time([&] {
            apply_ray_visibility(room.model.tree, room.model.rays, {rays_per_pair}, all.pairs,
                                 all.links, progress);
        });
    }
    // A pair is read and its link updated; the scene fits into the cache.
    meter.report("rays", static_cast<double>(all.pairs.size()) * rays_per_pair,
                 (sizeof(LinkedPair) + 2.0 * sizeof(RawLink)) / rays_per_pair);
}
BENCHMARK(visibility_rays)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace antiradiance::bench
