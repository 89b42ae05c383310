// SPDX-License-Identifier: GPL-3.0-or-later
// Link creation and visibility, from hierarchy to sorted link mesh.
#include <benchmark/benchmark.h>

#include "links/visibility.h"
#include "pipeline/stopwatch.h"
#include "stages.h"
#include "triad.h"

namespace antiradiance::bench {

namespace {

// Written once by refinement and once by each of the two sorting steps, which read it as well.
constexpr double kBytesPerMadeLink = 2.0 * sizeof(RawLink) + 4.0 * sizeof(Link);

// Refinement, form factors and sorting; links that no ray passes count as made.
void link_creation(benchmark::State& state, Visibility visibility) {
    Stages room(visibility);
    const TriadBound bound(state);
    double seconds = 0;
    for (auto _ : state) {
        Progress progress;
        const Model model = build_model(room.scene, room.options, progress);
        state.SetIterationTime(model.links_seconds);
        seconds += model.links_seconds;
    }
    const auto links = static_cast<double>(room.model.links.links.size());
    const double rate = links * static_cast<double>(state.iterations()) / seconds;
    state.counters["links"] = links;
    state.counters["leaves"] = static_cast<double>(room.model.tree.leaves.size());
    state.counters["links/s"] = rate;
    bound.report(rate, kBytesPerMadeLink);
}
BENCHMARK_CAPTURE(link_creation, IMPLICIT, Visibility::kImplicit)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(link_creation, EXPLICIT, Visibility::kExplicit)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

// Every + link of the implicit mesh, each with rays of its own.
struct Pairs {
    std::vector<RawLink> links;
    std::vector<LinkedPair> pairs;
};

Pairs all_pairs(const LinkSet& set) {
    Pairs all;
    for (const Segment& s : set.segments) {
        for (std::uint32_t l = s.begin; l < s.end; ++l) {
            const Link& link = set.links[l];
            if (link.form_factor < 0) continue;
            const auto first = static_cast<std::uint32_t>(all.links.size());
            all.links.push_back({s.receiver, link.source, link.form_factor, 0});
            all.pairs.push_back({link.source, s.receiver, first, 1});
        }
    }
    return all;
}

void visibility_rays(benchmark::State& state) {
    const Stages& room = stages(Visibility::kImplicit);
    Pairs all = all_pairs(room.model.links);
    const int rays_per_pair = room.options.visibility_rays;
    const TriadBound bound(state);
    Stopwatch watch;
    for (auto _ : state) {
        Progress progress;
        apply_ray_visibility(room.model.tree, room.model.rays, rays_per_pair, all.pairs, all.links,
                             progress);
    }
    const double rays = static_cast<double>(all.pairs.size()) * rays_per_pair;
    const double rate = rays * static_cast<double>(state.iterations()) / watch.lap();
    state.counters["rays/s"] = rate;
    // A pair is read and its link updated; the scene fits into the cache.
    bound.report(rate, (sizeof(LinkedPair) + 2.0 * sizeof(RawLink)) / rays_per_pair);
}
BENCHMARK(visibility_rays)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace antiradiance::bench
