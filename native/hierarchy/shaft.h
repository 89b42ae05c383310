// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "hierarchy/convex_regions.h"

namespace antiradiance {

// Whether a region blocks all segments between the convex hulls of two point sets (a shaft, Haines
// & Wallace 1991, "Shaft Culling for Efficient Ray-Traced Radiosity"): they lie on either side of
// its plane, and the segments between their corners meet it inside its outline. By convexity those
// of all other points then do as well. Points may lie on the plane, as those of a floor that a wall
// stands on do, but not all of a set.
class ShaftTest {
public:
    explicit ShaftTest(const ConvexRegions& regions) : regions_(regions) {}

    [[nodiscard]] bool blocks(RegionId region, std::span<const vec3> from,
                              std::span<const vec3> to);

private:
    // Heights of points above the plane, times side; false: not all of them lie there.
    bool heights(const ConvexRegion& region, std::span<const vec3> points, float side,
                 std::vector<float>& result) const;

    const ConvexRegions& regions_;
    std::vector<float> from_height_, to_height_, from_distance_, to_distance_;
};

}  // namespace antiradiance
