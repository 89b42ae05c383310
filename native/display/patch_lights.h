// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "hierarchy/patch_tree.h"

namespace antiradiance {

// Every patch as a light source ("PLS", the paper's section 5), and every cluster as a point that
// sends an intensity by direction, with what lighting a point by it takes.
struct PatchLight {
    vec3 center{0};    // m
    float radius = 0;  // m, bounding sphere
    vec3 normal{0};    // unit; clusters: 0
    float area = 0;    // m2; clusters: 0
    vec3 radiance{0};  // W/(m2 sr), in front; clusters: 0
    [[nodiscard]] bool is_cluster() const { return area == 0; }
};

struct LightPoint {
    vec3 position;  // m
    vec3 normal;    // unit
};

class PatchLights {
public:
    static constexpr int kMostSamples = 16;

    // radiance: #nodes, pulled. samples: points on each light, 1..kMostSamples.
    PatchLights(const PatchTree& tree, std::span<const vec3> radiance, int samples);

    [[nodiscard]] const PatchLight& operator[](NodeId n) const {
        return lights_[static_cast<std::size_t>(n)];
    }
    // The light's points, uniform by area, below clusters by the light that they send; the first
    // few of them are spread over all of it too. They depend on the patch alone, so that animations
    // do not flicker.
    [[nodiscard]] std::span<const LightPoint> points(NodeId n) const {
        const auto count = static_cast<std::size_t>(samples_);
        return {points_.data() + static_cast<std::size_t>(n) * count, count};
    }
    [[nodiscard]] int samples() const { return samples_; }

private:
    int samples_;
    std::vector<PatchLight> lights_;  // #nodes
    std::vector<LightPoint> points_;  // #nodes x samples
};

}  // namespace antiradiance
