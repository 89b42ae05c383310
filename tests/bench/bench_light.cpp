// SPDX-License-Identifier: GPL-3.0-or-later
// Direct light on the leaves, and the picture.
#include <benchmark/benchmark.h>

#include "display/display.h"
#include "pipeline/stopwatch.h"
#include "stages.h"
#include "triad.h"

namespace antiradiance::bench {

namespace {

void direct_light(benchmark::State& state) {
    const Stages& room = stages(Visibility::kExplicit);
    const TriadBound bound(state);
    Stopwatch watch;
    for (auto _ : state) {
        Progress progress;
        benchmark::DoNotOptimize(room.direct->leaf_irradiance(room.model.tree, progress));
    }
    const double rate = static_cast<double>(room.model.tree.leaves.size()) *
                        static_cast<double>(state.iterations()) / watch.lap();
    state.counters["leaves/s"] = rate;
    bound.report(rate, sizeof(vec3));
}
BENCHMARK(direct_light)->UseRealTime()->Unit(benchmark::kMillisecond);

void display(benchmark::State& state) {
    const Stages& room = stages(Visibility::kExplicit);
    const std::vector<vec3> irradiance(room.model.tree.size(), vec3(1));
    const TriadBound bound(state);
    Stopwatch watch;
    for (auto _ : state) {
        Progress progress;
        benchmark::DoNotOptimize(
            make_picture({room.scene, room.model.rays, room.model.tree, *room.direct, irradiance},
                         DisplayMode::kPatches, progress));
    }
    const double pixels = static_cast<double>(room.scene.camera.width) * room.scene.camera.height;
    const double rate = pixels * static_cast<double>(state.iterations()) / watch.lap();
    state.counters["pixels/s"] = rate;
    bound.report(rate, sizeof(vec4) + sizeof(float) + sizeof(vec3));
}
BENCHMARK(display)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace antiradiance::bench
