// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/interleave.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace antiradiance {

namespace {

constexpr float kLeastCosine = 0.9F;  // between the normals of fragments that are averaged
constexpr float kMostHeight = 0.1F;   // of one above the other's plane, in units of their distance

bool on_one_surface(const Fragment& a, const Fragment& b) {
    if (glm::dot(a.shading_normal, b.shading_normal) < kLeastCosine) return false;
    const vec3 d = b.position - a.position;
    const float height = std::max(std::abs(glm::dot(d, a.normal)), std::abs(glm::dot(d, b.normal)));
    return height * height <= kMostHeight * kMostHeight * glm::dot(d, d);
}

}  // namespace

std::vector<vec3> interleave_blur(const GBuffer& buffer, std::span<const vec3> irradiance, int n,
                                  Progress& progress) {
    if (n <= 1) return {irradiance.begin(), irradiance.end()};
    const std::vector<std::uint32_t> first = pixel_starts(buffer);
    std::vector<vec3> result(irradiance.size());
    parallel_for_blocks(result.size(), 256, progress, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Fragment& center = buffer.fragments[i];
            const int x = static_cast<int>(center.pixel) % buffer.width;
            const int y = static_cast<int>(center.pixel) / buffer.width;
            vec3 sum(0);
            float weight = 0;
            for (int v = std::max(0, y - n / 2); v < std::min(buffer.height, y + n - n / 2); ++v) {
                for (int u = std::max(0, x - n / 2); u < std::min(buffer.width, x + n - n / 2);
                     ++u) {
                    const auto pixel = static_cast<std::size_t>(v * buffer.width + u);
                    for (std::uint32_t j = first[pixel]; j < first[pixel + 1]; ++j) {
                        const Fragment& other = buffer.fragments[j];
                        if (j != i && !on_one_surface(center, other)) continue;
                        sum += other.coverage * irradiance[j];
                        weight += other.coverage;
                    }
                }
            }
            result[i] = weight > 0 ? sum / weight : irradiance[i];
        }
    });
    return result;
}

}  // namespace antiradiance
