// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

#include "base/types.h"

namespace antiradiance::test {

// Of two fields of light over the same nodes: RMS of their difference over that of the reference.
inline double relative_rms(const std::vector<vec3>& values, const std::vector<vec3>& reference) {
    double error = 0;
    double norm = 0;
    for (std::size_t n = 0; n < values.size(); ++n) {
        const vec3 difference = values[n] - reference[n];
        error += static_cast<double>(glm::dot(difference, difference));
        norm += static_cast<double>(glm::dot(reference[n], reference[n]));
    }
    return std::sqrt(error / norm);
}

}  // namespace antiradiance::test
