// SPDX-License-Identifier: GPL-3.0-or-later
// What the oracle asks about two nodes.
#pragma once

#include "hierarchy/growing_tree.h"

namespace antiradiance {

enum class PlaneSide { kBehind, kStraddles, kInFront };

// Where a patch lies against the plane of another; coplanar counts as behind.
PlaneSide side_of_plane(const GrowingNode& patch, const GrowingNode& plane);

// Whether any point of `source` can lie in front of `receiver` (patch: its plane; cluster: its cone
// of normals). Never false by mistake.
bool may_receive(const GrowingNode& receiver, const GrowingNode& source);

// ff(source -> receiver) between patches, averaged over 1, 2 x 2 or 4 x 4 points of the receiver by
// distance; only points on the given side of the source count.
float patch_form_factor(const GrowingNode& source, const GrowingNode& receiver, bool behind_source);

// Point of a patch for a sample of the unit square.
vec3 point_of(const GrowingNode& patch, const vec2& sample);

}  // namespace antiradiance
