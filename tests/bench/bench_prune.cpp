// SPDX-License-Identifier: GPL-3.0-or-later
// Link pruning; all rates count the + and - links of the mesh together.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "links/visibility.h"
#include "meter.h"
#include "pairs.h"
#include "prune/prune.h"
#include "stages.h"

namespace antiradiance::bench {

namespace {

// A link is read by each of the two passes, its verdict written by both and read by the second.
constexpr double kBytesPerJudgedLink = 2.0 * sizeof(Link) + 3.0;

void prune_index(benchmark::State& state) {
    const Model& model = stages(Visibility::kImplicit).model;
    const auto links = static_cast<double>(model.links.links.size());
    Meter meter(state);
    std::size_t bytes = 0;
    for (auto _ : state) {
        meter.time([&] {
            const LinkIndex index(model.tree, model.links);
            bytes = index.bytes();
        });
    }
    state.counters["links"] = links;
    state.counters["bytes/link"] = static_cast<double>(bytes) / links;
    meter.report("links", links, static_cast<double>(bytes) / links);
}
BENCHMARK(prune_index)->UseManualTime()->Unit(benchmark::kMillisecond);

// Convex regions and corners: what the shaft test needs of the scene.
void prune_blockers(benchmark::State& state) {
    const Stages& room = stages(Visibility::kImplicit);
    Meter meter(state);
    for (auto _ : state) {
        meter.time([&] {
            const Blockers blockers(room.scene, room.model.tree);
            benchmark::DoNotOptimize(blockers.regions.regions.data());
        });
    }
    const double triangles = static_cast<double>(room.scene.triangles.size());
    meter.report("triangles", triangles, sizeof(uvec3));
}
BENCHMARK(prune_blockers)->UseManualTime()->Unit(benchmark::kMillisecond);

// From the link set to the links to remove, with all tables.
void prune(benchmark::State& state, const PruneOptions& options) {
    const Stages& room = stages(Visibility::kImplicit);
    const auto links = static_cast<double>(room.model.links.links.size());
    Meter meter(state);
    RemovedLinks removed;
    for (auto _ : state) {
        Progress progress;
        meter.time([&] {
            removed =
                find_removed_links({room.scene, room.model.tree, room.model.links, room.model.rays},
                                   options, progress);
        });
    }
    state.counters["links"] = links;
    state.counters["removed"] =
        static_cast<double>(std::count(removed.begin(), removed.end(), std::uint8_t{1}));
    meter.report("links", links, kBytesPerJudgedLink);
}
constexpr PruneOptions kHeuristic1{.method = PruneMethod::kHeuristic1};
constexpr PruneOptions kHeuristic1Text{.method = PruneMethod::kHeuristic1,
                                       .directions = PruneDirections::kText};
constexpr PruneOptions kHeuristic2{.method = PruneMethod::kHeuristic2};
constexpr PruneOptions kConservative{.method = PruneMethod::kConservative};
constexpr PruneOptions kConservativeAlgorithm3{
    .method = PruneMethod::kConservative, .conservative_keeps = ConservativeKeeps::kAlgorithm3};
BENCHMARK_CAPTURE(prune, HEURISTIC_1, kHeuristic1)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(prune, HEURISTIC_1_text, kHeuristic1Text)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(prune, HEURISTIC_2, kHeuristic2)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(prune, CONSERVATIVE_algorithm_3, kConservativeAlgorithm3)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(prune, CONSERVATIVE, kConservative)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

// What pruning competes with: rays on every + link of the same mesh.
void four_rays_a_plus_link(benchmark::State& state) {
    const Stages& room = stages(Visibility::kImplicit);
    Pairs all = all_pairs(room.model.links);
    const auto links = static_cast<double>(room.model.links.links.size());
    Meter meter(state);
    for (auto _ : state) {
        Progress progress;
        meter.time([&] {
            apply_ray_visibility(room.model.tree, room.model.rays, {4}, all.pairs, all.links,
                                 progress);
        });
    }
    state.counters["links"] = links;
    state.counters["plus_links"] = static_cast<double>(all.links.size());
    meter.report("links", links, sizeof(LinkedPair) + 2.0 * sizeof(RawLink));
}
BENCHMARK(four_rays_a_plus_link)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace antiradiance::bench
