// SPDX-License-Identifier: GPL-3.0-or-later
// The executor: loops over TBB that report progress and stop within a fraction of a second.
#pragma once

#include <cstddef>
#include <functional>

#include "base/progress.h"

namespace antiradiance {

// The part [begin, end] of the current stage's bar that a loop fills.
struct ProgressSpan {
    float begin = 0;
    float end = 1;
};

// Calls body(i) for every i in [0, count) on all cores. The calling thread does not work: it polls
// the caller every few milliseconds, because Blender's callbacks must come from the thread that
// called us; so a stage stops as soon as its running bodies end. Keep a body under about 50 ms.
// An exception of a body or of a callback ends the loop and is thrown here. While the progress is
// paused, bodies that run end and no other begins.
void parallel_for(std::size_t count, Progress& progress,
                  const std::function<void(std::size_t)>& body, ProgressSpan span = {});

// As above in blocks of at most `block` indices: body(begin, end). For work that is small per index
// or that keeps scratch memory per block.
void parallel_for_blocks(std::size_t count, std::size_t block, Progress& progress,
                         const std::function<void(std::size_t, std::size_t)>& body,
                         ProgressSpan span = {});

}  // namespace antiradiance
