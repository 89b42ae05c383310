// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "base/progress.h"

namespace antiradiance {

// Runs core work without the GIL. progress(fraction, stage) is called by this thread, cancelled()
// -> bool by another; either may be None. False: the work was cancelled. Throws what the work
// throws, and what a callback has thrown.
bool run_with_callbacks(pybind11::object progress, pybind11::object cancelled,
                        const std::function<void(Progress&)>& work);

}  // namespace antiradiance
