// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "base/progress.h"
#include "display/gbuffer.h"

namespace antiradiance {

// Which of the n^2 subsets of the sources lights a pixel: its place in its block of n x n.
[[nodiscard]] inline std::uint32_t interleave_subset(std::uint32_t pixel, int width, int n) {
    const auto w = static_cast<std::uint32_t>(width);
    const auto across = static_cast<std::uint32_t>(n);
    return pixel / w % across * across + pixel % w % across;
}

// Averages what interleaved sampling left different from pixel to pixel: over windows of n x n
// pixels, which hold each subset of the sources once, and there over fragments of about the same
// plane only (Segovia et al. 2006). irradiance: #fragments.
[[nodiscard]] std::vector<vec3> interleave_blur(const GBuffer& buffer,
                                                std::span<const vec3> irradiance, int n,
                                                Progress& progress);

}  // namespace antiradiance
