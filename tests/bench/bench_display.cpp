// SPDX-License-Identifier: GPL-3.0-or-later
// The sums that a back end of the display computes: final shooting and splatting without the
// G-buffer, the lists of sources and the antiradiance. An item is a pair of a fragment and a source
// (or disk).
#include <benchmark/benchmark.h>

#include <random>

#include "display/display_backend.h"
#include "display/gbuffer.h"
#include "meter.h"
#include "stages.h"

namespace antiradiance::bench {

namespace {

using MakeBackend = std::unique_ptr<DisplayBackend> (*)(std::string& why_not);

std::unique_ptr<DisplayBackend> cpu(std::string&) {
    return make_cpu_display();
}

// What the room's camera sees, and random light. A quarter of the pixels, for software renderers.
struct View {
    const Stages& room = stages(Visibility::kImplicit);
    Scene scene = room.scene;
    Progress progress;
    std::vector<vec3> light;
    GBuffer buffer;
    AntiradianceTable antiradiance;
    BinWeights bins{room.model.links.bins, 256};

    View() : light(room.model.tree.size()) {
        scene.camera.width = scene.camera.x1 = 160;
        scene.camera.height = scene.camera.y1 = 120;
        std::mt19937 random(1);
        std::uniform_real_distribution<float> uniform(0, 1);
        for (vec3& l : light)
            l = vec3(uniform(random));
        buffer = make_gbuffer({scene, scene.camera, room.model.rays, room.model.tree,
                               room.direct.get(), light, light, false, false, 4, 16},
                              progress, {});
        antiradiance = antiradiance_table(room.model.tree, room.model.links, light, progress);
    }
    [[nodiscard]] FragmentGroups tiles() const {
        return tile_groups(buffer, vec3(scene.camera.to_world[3]), 8);
    }
};

const View& view() {
    static const View made;
    return made;
}

double pairs(const FragmentGroups& groups, const SourceLists& lists) {
    double sum = 0;
    for (std::size_t g = 0; g < groups.groups.size(); ++g) {
        sum += static_cast<double>(groups.groups[g].end - groups.groups[g].begin) *
               static_cast<double>(lists.of(g).size());
    }
    return sum;
}

// work(backend, progress), `count` pairs a call.
template <typename Work>
void measure(benchmark::State& state, MakeBackend make, double count, const Work& work) {
    std::string why_not;
    const std::unique_ptr<DisplayBackend> backend = make(why_not);
    if (!backend) {
        state.SkipWithError(why_not.c_str());
        return;
    }
    Meter meter(state);
    for (auto _ : state) {
        Progress progress;
        meter.time([&] { benchmark::DoNotOptimize(work(*backend, progress)); });
    }
    state.SetLabel(backend->renderer());
    state.counters["pairs"] = count;
    meter.report("samples", count, sizeof(NodeId));
}

void shoot(benchmark::State& state, MakeBackend make, ShootingLevel level, int interleave) {
    const View& v = view();
    const PatchTree& tree = v.room.model.tree;
    const FragmentGroups groups = v.tiles();
    Progress progress;
    const SourceLists lists = level == ShootingLevel::kCut
                                  ? cut_sources(tree, groups, CutRule{}, progress)
                                  : all_sources(tree, level, groups.groups.size());
    const PatchLights lights(tree, v.light, 8);
    const ShootingInput input{tree, v.buffer, groups, lists, v.light, interleave};
    measure(state, make, pairs(groups, lists) / (interleave * interleave),
            [&](DisplayBackend& backend, Progress& p) {
                return backend.shoot(
                    {input, lights, v.antiradiance, v.bins, 2 * v.room.model.rays.epsilon()}, p,
                    {});
            });
}

void splat(benchmark::State& state, MakeBackend make) {
    const View& v = view();
    const FragmentGroups groups = v.tiles();
    Progress progress;
    const SourceLists disks = find_disks(v.room.model.tree, groups, progress);
    measure(state, make, pairs(groups, disks), [&](DisplayBackend& backend, Progress& p) {
        return backend.splat({v.room.model.tree, v.light, v.buffer, groups, disks}, p, {});
    });
}

#define BACKEND_BENCHMARK(work, name, ...) \
    BENCHMARK_CAPTURE(work, name, __VA_ARGS__)->UseManualTime()->Unit(benchmark::kMillisecond)
BACKEND_BENCHMARK(shoot, cpu_cut, &cpu, ShootingLevel::kCut, 1);
BACKEND_BENCHMARK(shoot, cpu_cut_4x4, &cpu, ShootingLevel::kCut, 4);
BACKEND_BENCHMARK(shoot, cpu_leaves_4x4, &cpu, ShootingLevel::kLeaves, 4);
BACKEND_BENCHMARK(shoot, opengl_cut, &make_gl_display, ShootingLevel::kCut, 1);
BACKEND_BENCHMARK(shoot, opengl_cut_4x4, &make_gl_display, ShootingLevel::kCut, 4);
BACKEND_BENCHMARK(shoot, opengl_leaves_4x4, &make_gl_display, ShootingLevel::kLeaves, 4);
BACKEND_BENCHMARK(splat, cpu, &cpu);
BACKEND_BENCHMARK(splat, opengl, &make_gl_display);

}  // namespace

}  // namespace antiradiance::bench
