// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/direct_light_maps.h"

#include <algorithm>

#include "solve/direct_light_estimate.h"

namespace antiradiance {

namespace {

constexpr std::size_t kBlock = 64;  // points; below a millisecond

}  // namespace

MappedLight::MappedLight(const DirectLight::Impl& light, const Scene& scene, Progress& progress)
    : emitters_(light, scene), maps_(scene, emitters_.points(), light.rays.epsilon(), progress) {}

std::vector<vec3> MappedLight::irradiance(std::span<const SurfacePoint> points,
                                          std::span<const std::uint32_t> ends, Progress& progress,
                                          ProgressSpan span) const {
    std::vector<vec3> at(points.size());  // W/m2
    const std::size_t row = emitters_.points().size();
    const std::size_t batch = maps_.batch_size();
    std::vector<float> visibility(batch * row);
    const auto share = [&](std::size_t done) {
        return span.begin + (span.end - span.begin) * static_cast<float>(done) /
                                static_cast<float>(points.size());
    };
    for (std::size_t first = 0; first < points.size(); first += batch) {
        const std::size_t count = std::min(batch, points.size() - first);
        progress.report(share(first));
        maps_.look_up(points.subspan(first, count), visibility);
        parallel_for_blocks(count, kBlock, progress,
                            [&](std::size_t begin, std::size_t end) {
                                for (std::size_t i = begin; i < end; ++i) {
                                    at[first + i] = emitters_.irradiance(
                                        points[first + i],
                                        std::span(visibility).subspan(i * row, row));
                                }
                            },
                            {share(first), share(first + count)});
    }
    std::vector<vec3> means;
    means.reserve(ends.size());
    std::uint32_t begin = 0;
    for (const std::uint32_t end : ends) {
        vec3 sum(0);
        for (std::uint32_t i = begin; i < end; ++i)
            sum += at[i];
        means.push_back(end > begin ? sum / static_cast<float>(end - begin) : sum);
        begin = end;
    }
    return means;
}

}  // namespace antiradiance
