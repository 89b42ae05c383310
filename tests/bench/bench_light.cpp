// SPDX-License-Identifier: GPL-3.0-or-later
// Direct light on the leaves, and the picture.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

#include "display/display.h"
#include "gpu/gl_thread.h"
#include "meter.h"
#include "pipeline/show.h"
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

// The same leaves by shadow maps, and the drawing of the maps.
void shadow_maps(benchmark::State& state) {
    const Stages& room = stages(Visibility::kExplicit);
    std::string why_not;
    if (!gpu::GlThread::shared(why_not)) return state.SkipWithError(why_not.c_str());
    Progress progress;
    const DirectLight maps(room.scene, room.model.rays, DirectLightMode::kShadowMaps, progress);
    Meter meter(state);
    for (auto _ : state) {
        meter.time(
            [&] { benchmark::DoNotOptimize(maps.leaf_irradiance(room.model.tree, progress)); });
    }
    meter.report("leaves", static_cast<double>(room.model.tree.leaves.size()), sizeof(vec3));
}
BENCHMARK(shadow_maps)->UseManualTime()->Unit(benchmark::kMillisecond);

void draw_shadow_maps(benchmark::State& state) {
    const Stages& room = stages(Visibility::kExplicit);
    std::string why_not;
    if (!gpu::GlThread::shared(why_not)) return state.SkipWithError(why_not.c_str());
    Progress progress;
    DirectLight::Maps drawn;
    Meter meter(state);
    for (auto _ : state) {
        meter.time([&] {
            drawn = DirectLight(room.scene, room.model.rays, DirectLightMode::kShadowMaps, progress)
                        .maps();
        });
    }
    meter.report("images", static_cast<double>(drawn.images),
                 static_cast<double>(drawn.bytes / std::max<std::size_t>(drawn.images, 1)));
}
BENCHMARK(draw_shadow_maps)->UseManualTime()->Unit(benchmark::kMillisecond);

void display(benchmark::State& state, const DisplayOptions& options,
             const PictureQuality& quality = {}) {
    const Stages& room = stages(Visibility::kExplicit);
    const std::vector<vec3> light(room.model.tree.size(), vec3(1));
    const std::unique_ptr<DisplayBackend> backend = make_cpu_display();
    Meter meter(state);
    for (auto _ : state) {
        Progress progress;
        meter.time([&] {
            benchmark::DoNotOptimize(make_picture(
                {room.scene, room.scene.camera, room.model.rays, room.model.planes, room.model.tree,
                 room.model.links, nullptr, *room.direct, light, light, light, false,
                 quality.samples_per_axis, quality.direct_of_leaves},
                options, *backend, progress));
        });
    }
    const double pixels = static_cast<double>(room.scene.camera.width) * room.scene.camera.height;
    meter.report("pixels", pixels, sizeof(vec4) + sizeof(float) + sizeof(vec3));
}
constexpr DisplayOptions shooting(ShootingVisibility visibility, ShootingLevel level,
                                  int interleave) {
    return {.mode = DisplayMode::kFinalShooting,
            .shooting_level = level,
            .shooting_visibility = visibility,
            .interleave = interleave};
}
#define DISPLAY_BENCHMARK(name, ...) \
    BENCHMARK_CAPTURE(display, name, __VA_ARGS__)->UseManualTime()->Unit(benchmark::kMillisecond)
DISPLAY_BENCHMARK(patches, {DisplayMode::kPatches});
DISPLAY_BENCHMARK(splatting, {DisplayMode::kSplatting});
// What a viewport shows while its camera moves.
DISPLAY_BENCHMARK(navigation, {DisplayMode::kSplatting},
                  {.samples_per_axis = 1, .direct_of_leaves = true});

constexpr auto kRays = ShootingVisibility::kRays;
constexpr auto kAntiradiance = ShootingVisibility::kAntiradiance;
DISPLAY_BENCHMARK(rays_cut, shooting(kRays, ShootingLevel::kCut, 1));
DISPLAY_BENCHMARK(rays_cut_4x4, shooting(kRays, ShootingLevel::kCut, 4));
DISPLAY_BENCHMARK(shooting_cut, shooting(kAntiradiance, ShootingLevel::kCut, 1));
DISPLAY_BENCHMARK(shooting_cut_4x4, shooting(kAntiradiance, ShootingLevel::kCut, 4));
DISPLAY_BENCHMARK(shooting_cut_8x8, shooting(kAntiradiance, ShootingLevel::kCut, 8));
DISPLAY_BENCHMARK(shooting_parents, shooting(kAntiradiance, ShootingLevel::kParents, 1));
DISPLAY_BENCHMARK(shooting_leaves, shooting(kAntiradiance, ShootingLevel::kLeaves, 1));
DISPLAY_BENCHMARK(shooting_leaves_8x8, shooting(kAntiradiance, ShootingLevel::kLeaves, 8));

}  // namespace

}  // namespace antiradiance::bench
