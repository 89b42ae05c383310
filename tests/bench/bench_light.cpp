// SPDX-License-Identifier: GPL-3.0-or-later
// Direct light on the leaves, and the picture.
#include <benchmark/benchmark.h>

#include "display/display.h"
#include "meter.h"
#include "stages.h"

namespace antiradiance::bench {

namespace {

void direct_light(benchmark::State& state) {
    const Stages& room = stages(Visibility::kExplicit);
    Meter meter(state);
    for (auto _ : state) {
        Progress progress;
        meter.time([&] {
            benchmark::DoNotOptimize(room.direct->leaf_irradiance(room.model.tree, progress));
        });
    }
    meter.report("leaves", static_cast<double>(room.model.tree.leaves.size()), sizeof(vec3));
}
BENCHMARK(direct_light)->UseManualTime()->Unit(benchmark::kMillisecond);

void display(benchmark::State& state) {
    const Stages& room = stages(Visibility::kExplicit);
    const std::vector<vec3> irradiance(room.model.tree.size(), vec3(1));
    Meter meter(state);
    for (auto _ : state) {
        Progress progress;
        meter.time([&] {
            benchmark::DoNotOptimize(make_picture(
                {room.scene, room.model.rays, room.model.tree, *room.direct, irradiance},
                DisplayMode::kPatches, progress));
        });
    }
    const double pixels = static_cast<double>(room.scene.camera.width) * room.scene.camera.height;
    meter.report("pixels", pixels, sizeof(vec4) + sizeof(float) + sizeof(vec3));
}
BENCHMARK(display)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace antiradiance::bench
