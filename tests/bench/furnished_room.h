// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/scene.h"

namespace antiradiance::bench {

// An office of 7 m x 5 m x 2.8 m with desks, monitors and a shelf under two emissive panels, and a
// camera of 320 x 240 pixels.
Scene make_furnished_room();

}  // namespace antiradiance::bench
