// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/bin_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/parallel.h"

namespace antiradiance {

namespace {

constexpr int kBlock = 16;  // texels along a side of the blocks that share a search

struct Near {
    float cosine;
    std::uint16_t bin;
};

// Bins that can be among the nearest of any texel of a block: the bins that the block's centre
// sees within the distance of its own last one plus twice the block's radius.
std::vector<std::uint16_t> candidates(const DirectionBins& bins, const vec3& center, float radius) {
    std::vector<float> angles;
    for (int b = 0; b < bins.count(); ++b)
        angles.push_back(std::acos(std::clamp(glm::dot(center, bins.axis(b)), -1.0F, 1.0F)));
    std::vector<float> sorted = angles;
    std::nth_element(sorted.begin(), sorted.begin() + BinWeights::kNearest, sorted.end());
    const float reach = sorted[BinWeights::kNearest] + 2 * radius;
    std::vector<std::uint16_t> found;
    for (std::size_t b = 0; b < angles.size(); ++b) {
        if (angles[b] <= reach) found.push_back(static_cast<std::uint16_t>(b));
    }
    return found;
}

// Weights that fall to 0 at the distance of the first bin that is left out, so that they are
// continuous over the sphere.
BinWeights::Texel weigh(const DirectionBins& bins, std::span<const std::uint16_t> of,
                        const vec3& direction) {
    constexpr int kCount = BinWeights::kNearest;
    std::vector<Near> near;
    for (const std::uint16_t b : of)
        near.push_back({glm::dot(direction, bins.axis(b)), b});
    std::partial_sort(near.begin(), near.begin() + kCount + 1, near.end(),
                      [](const Near& a, const Near& b) { return a.cosine > b.cosine; });
    std::array<float, kCount> weight;
    for (std::size_t i = 0; i < kCount; ++i) {
        const float above = near[i].cosine - near[kCount].cosine;
        weight[i] = above * above;
    }
    const float sum = std::max(std::accumulate(weight.begin(), weight.end(), 0.0F), 1e-30F);
    BinWeights::Texel texel{};
    int left = 255;
    for (std::size_t i = kCount; i-- > 0;) {
        texel.bin[i] = near[i].bin;
        const int share = i == 0 ? left : static_cast<int>(std::lround(255 * weight[i] / sum));
        texel.weight[i] = static_cast<std::uint8_t>(share);
        left -= share;
    }
    return texel;
}

}  // namespace

BinWeights::BinWeights(const DirectionBins& bins, int face_size)
    : face_size_(face_size), texels_(6UL * face_size * face_size) {
    const int across = (face_size + kBlock - 1) / kBlock;
    Progress progress;
    parallel_for(static_cast<std::size_t>(6 * across * across), progress, [&](std::size_t i) {
        const int face = static_cast<int>(i) / (across * across);
        const int y0 = static_cast<int>(i) / across % across * kBlock;
        const int x0 = static_cast<int>(i) % across * kBlock;
        const int y1 = std::min(y0 + kBlock, face_size);
        const int x1 = std::min(x0 + kBlock, face_size);
        const auto at = [&](int x, int y) {
            return glm::normalize(cube_texel_direction(face, x, y, face_size));
        };
        const vec3 center = at((x0 + x1) / 2, (y0 + y1) / 2);
        // A texel is widest in the middle of a face.
        const float radius = 1.5F * kBlock * 2 / static_cast<float>(face_size);
        const std::vector<std::uint16_t> near = candidates(bins, center, radius);
        for (int y = y0; y < y1; ++y) {
            for (int x = x0; x < x1; ++x)
                texels_[static_cast<std::size_t>((face * face_size + y) * face_size + x)] =
                    weigh(bins, near, at(x, y));
        }
    });
}

}  // namespace antiradiance
