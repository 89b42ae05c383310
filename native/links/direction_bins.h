// SPDX-License-Identifier: GPL-3.0-or-later
// World-space directions of nearly equal solid angle.
#pragma once

#include <vector>

#include "base/types.h"

namespace antiradiance {

// n Fibonacci-sphere directions (Swinbank & Purser 2006), tilted so that no border of a bin falls
// on an axis; each direction of space belongs to the nearest one. Lookup by a cube map of bin
// numbers.
class DirectionBins {
public:
    DirectionBins() = default;
    explicit DirectionBins(int count);  // 32..1024

    [[nodiscard]] int count() const { return static_cast<int>(axes_.size()); }
    [[nodiscard]] const vec3& axis(int bin) const { return axes_[static_cast<std::size_t>(bin)]; }
    [[nodiscard]] int bin(const vec3& direction) const;  // any length but 0
    [[nodiscard]] float mean_solid_angle() const { return 4 * kPi / static_cast<float>(count()); }

    // C(b) = integral over bin b of max(0, -d . n), sr: the projected solid angle through which
    // light that travels along the bin reaches a surface with normal n; floored at 1e-3 of the bin.
    [[nodiscard]] std::vector<float> projected_solid_angles(const vec3& normal) const;  // #bins

private:
    // Texels along a cube face: odd, so that an axis of the world meets the middle of one. Between
    // two, rounding would throw the links of parallel walls from bin to bin.
    static constexpr int kFaceSize = 129;
    struct Texel {
        vec3 direction;
        float solid_angle;
    };
    std::vector<vec3> axes_;
    std::vector<std::uint16_t> table_;  // 6 * kFaceSize^2 bin numbers
    // A coarser cube map, bin by bin, to integrate over.
    std::vector<Texel> texels_;
    std::vector<std::uint32_t> bin_texels_;  // #bins + 1
};

}  // namespace antiradiance
