// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "base/progress.h"
#include "links/link_set.h"
#include "prune/link_visibility.h"
#include "scene/ray_scene.h"

namespace antiradiance {

struct TraceOptions {
    int rays_per_link = 64;  // 1..
    BlockingSides blocking_sides = BlockingSides::kAny;
};

// The truth that heuristics are measured by: segments between random points of both ends of every
// link. None is free: kNone; all are: kFull. A link whose ends have no points that face each other
// carries nothing: kNone.
// Shadow rays stand off surfaces by their epsilon and so step over the foot of a wall: of the
// segments that they find free, one at least must be free from point to point as well. What lies in
// the plane of an end hides nothing there.
// #links. Deterministic.
std::vector<LinkVisibility> trace_visibility(const Scene& scene, const PatchTree& tree,
                                             const LinkSet& links, const RayScene& rays,
                                             const TraceOptions& options, Progress& progress);

}  // namespace antiradiance
