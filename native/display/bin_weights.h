// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "links/cube_map.h"
#include "links/direction_bins.h"

namespace antiradiance {

// Interpolates a quantity that is kept per direction bin, so that the bins' borders do not show: a
// cube map of precomputed weights (the paper's section 5, which has 6 x 512 x 512 of them).
class BinWeights {
public:
    static constexpr int kNearest = 4;
    // A direction's nearest bins; weights are shares of 255 that add up to 255.
    struct Texel {
        std::uint16_t bin[kNearest];
        std::uint8_t weight[kNearest];
    };

    BinWeights(const DirectionBins& bins, int face_size);  // texels along a face

    [[nodiscard]] int face_size() const { return face_size_; }
    [[nodiscard]] std::span<const Texel> texels() const { return texels_; }

    // values: #bins. direction: any length but 0.
    [[nodiscard]] vec3 interpolate(std::span<const vec3> values, const vec3& direction) const {
        const Texel& t = texels_[cube_texel(direction, face_size_)];
        vec3 sum(0);
        for (int i = 0; i < kNearest; ++i)
            sum += static_cast<float>(t.weight[i]) * values[t.bin[i]];
        return sum * (1.0F / 255);
    }

private:
    int face_size_;
    std::vector<Texel> texels_;  // 6 * face_size^2
};

}  // namespace antiradiance
