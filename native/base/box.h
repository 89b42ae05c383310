// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

#include "base/types.h"

namespace antiradiance {

// Axis-aligned, m; low > high: empty.
struct Box {
    vec3 low{std::numeric_limits<float>::infinity()};
    vec3 high{-std::numeric_limits<float>::infinity()};

    void add(const vec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    void add(const Box& box) {
        low = glm::min(low, box.low);
        high = glm::max(high, box.high);
    }
};

}  // namespace antiradiance
