// SPDX-License-Identifier: GPL-3.0-or-later
// Rooms that several tests use. Metres; walls have albedo .7.
#pragma once

#include "scene/scene.h"

namespace antiradiance::test {

// 6 x 4 x 2.7 with two desks, a cupboard through whose back the wall runs and a luminous panel
// below the ceiling. The desks' blocks stand on the floor, whose patches below them are buried:
// without care the antiradiance of such patches grows without bound (algorithm.md "It can
// diverge").
Scene office();

// A camera in the office's far end that looks along it, down a little.
void add_office_camera(Scene& scene, int width, int height);

// 8 x 5 x 2.7: a corridor with four rooms behind open doors, two of them with a luminous panel. The
// partitions meet walls, floor and ceiling without cutting them.
Scene corridor();

// A room with `count`^3 boxes afloat, for links between clusters; a luminous panel below the
// ceiling.
Scene floating_boxes(int count);

}  // namespace antiradiance::test
