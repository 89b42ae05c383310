// SPDX-License-Identifier: GPL-3.0-or-later
// Blocking planes: which links of a mesh they cut, by their number.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "links/cut_links.h"
#include "meter.h"
#include "stages.h"
#include "support/scene_builder.h"

namespace antiradiance::bench {

namespace {

// Both ends of a link are looked up; beside them the link is read and its plane written.
constexpr double kBytesPerLink = sizeof(Link) + 2.0 * sizeof(vec3) + sizeof(BlockerId);

// `count` planes across the room, each a third of it wide and high.
BlockingPlanes planes_in_room(int count, float epsilon) {
    Scene scene;
    for (int i = 0; i < count; ++i) {
        const auto t = static_cast<float>(i);
        const float x = 0.3F + 6.4F * (t + 0.5F) / static_cast<float>(count);
        test::add_plane(scene, "Plane", {x, 1.6F * static_cast<float>(i % 3), 0.2F}, {0, 1.7F, 0},
                        {0, 0, 1});
    }
    return {scene.blockers, epsilon};
}

void cut_links(benchmark::State& state) {
    const Model& model = stages(Visibility::kImplicit).model;
    const BlockingPlanes planes =
        planes_in_room(static_cast<int>(state.range(0)), model.rays.epsilon());
    const auto links = static_cast<double>(model.links.links.size());
    Meter meter(state);
    std::vector<BlockerId> cut;
    for (auto _ : state) {
        Progress progress;
        meter.time([&] { cut = find_cut_links(model.tree, model.links, planes, progress); });
    }
    state.counters["links"] = links;
    state.counters["cut"] = links - static_cast<double>(std::ranges::count(cut, kNone));
    meter.report("links", links, kBytesPerLink);
}
BENCHMARK(cut_links)->Arg(1)->Arg(4)->Arg(32)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace antiradiance::bench
