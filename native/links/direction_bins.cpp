// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/direction_bins.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "links/cube_map.h"

namespace antiradiance {

namespace {

constexpr int kTexelFace = 40;  // texels along a cube face of the integration map

// Rotates away from the axes of the world, to which the walls of most scenes are parallel.
vec3 tilt(const vec3& d) {
    const glm::mat3 rotation(vec3(0.8047379F, 0.5058793F, -0.3106172F),
                             vec3(-0.3106172F, 0.8047379F, 0.5058793F),
                             vec3(0.5058793F, -0.3106172F, 0.8047379F));
    return glm::normalize(rotation * d);
}

}  // namespace

DirectionBins::DirectionBins(int count) {
    if (count < 32 || count > 1024)
        throw SceneError("direction_bins must lie between 32 and 1024, not " +
                         std::to_string(count));

    const float golden_angle = kPi * (3 - std::sqrt(5.0F));
    for (int i = 0; i < count; ++i) {
        const float z = 1 - (2 * static_cast<float>(i) + 1) / static_cast<float>(count);
        const float r = std::sqrt(1 - z * z);
        const float phi = golden_angle * static_cast<float>(i);
        axes_.push_back(tilt({r * std::cos(phi), r * std::sin(phi), z}));
    }

    const auto nearest = [&](const vec3& d) {
        int best = 0;
        float best_cosine = -2;
        for (int i = 0; i < count; ++i) {
            const float cosine = glm::dot(d, axes_[static_cast<std::size_t>(i)]);
            if (cosine > best_cosine) {
                best_cosine = cosine;
                best = i;
            }
        }
        return best;
    };

    table_.reserve(6UL * kFaceSize * kFaceSize);
    for (int face = 0; face < 6; ++face) {
        for (int y = 0; y < kFaceSize; ++y) {
            for (int x = 0; x < kFaceSize; ++x) {
                table_.push_back(static_cast<std::uint16_t>(
                    nearest(cube_texel_direction(face, x, y, kFaceSize))));
            }
        }
    }

    std::vector<std::vector<Texel>> by_bin(static_cast<std::size_t>(count));
    for (int face = 0; face < 6; ++face) {
        for (int y = 0; y < kTexelFace; ++y) {
            for (int x = 0; x < kTexelFace; ++x) {
                const vec3 d = cube_texel_direction(face, x, y, kTexelFace);
                const float side = 2.0F / kTexelFace;
                const float length = glm::length(d);
                const vec3 unit = d / length;
                by_bin[static_cast<std::size_t>(bin(unit))].push_back(
                    {unit, side * side / (length * length * length)});
            }
        }
    }
    bin_texels_.push_back(0);
    for (const auto& texels : by_bin) {
        texels_.insert(texels_.end(), texels.begin(), texels.end());
        bin_texels_.push_back(static_cast<std::uint32_t>(texels_.size()));
    }
}

int DirectionBins::bin(const vec3& direction) const {
    return table_[cube_texel(direction, kFaceSize)];
}

std::vector<float> DirectionBins::projected_solid_angles(const vec3& normal) const {
    std::vector<float> result(axes_.size());
    for (std::size_t b = 0; b < axes_.size(); ++b) {
        float projected = 0;
        float whole = 0;
        for (std::uint32_t i = bin_texels_[b]; i < bin_texels_[b + 1]; ++i) {
            projected +=
                std::max(0.0F, -glm::dot(texels_[i].direction, normal)) * texels_[i].solid_angle;
            whole += texels_[i].solid_angle;
        }
        result[b] = std::max(projected, 1e-3F * whole);
    }
    return result;
}

}  // namespace antiradiance
