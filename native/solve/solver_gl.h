// SPDX-License-Identifier: GPL-3.0-or-later
// The OpenGL solver: Eq. 3 and 4 as compute shaders that gather (Meyer et al. 2009, "Data-Parallel
// Hierarchical Link Creation for Radiosity", do the same in CUDA). shaders/README.md has the steps.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "solve/solver.h"

namespace antiradiance {

// 0: from the device's facts. Others are for tests, which reach every path with small scenes.
struct GlSolverConfig {
    std::size_t block_bytes = 0;     // largest buffer of links
    std::size_t resident_bytes = 0;  // of links and segments; the rest is sent in every pass
    std::size_t batch_bytes = 0;     // of the antiradiance of the bins of one batch
    std::uint32_t links_per_step = 0;
    std::uint32_t long_segment = 0;  // links from which a segment gets a work group of its own
};

// Null, with the reason in `why_not`, where OpenGL 4.5 can't be had.
[[nodiscard]] std::unique_ptr<Solver> make_gl_solver(const GlSolverConfig& config,
                                                     std::string& why_not);

}  // namespace antiradiance
