// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace antiradiance::gpu {

// The device, its driver or a shader failed. None of it is the scene's fault: a caller may go on
// with the CPU.
class GlError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace antiradiance::gpu
