// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace antiradiance {

// Bytes that this process may still take without swapping.
std::uint64_t available_memory_bytes();

// Peak resident memory of this process so far, bytes.
std::uint64_t peak_memory_bytes();

}  // namespace antiradiance
