// SPDX-License-Identifier: GPL-3.0-or-later
// What the artist's blocking planes do to the link mesh of a render.
#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "hierarchy/patch_tree.h"
#include "links/blocking_planes.h"
#include "links/refine.h"
#include "scene/ray_scene.h"
#include "scene/scene.h"

namespace antiradiance {

struct BlockerCuts {
    std::vector<LinkCount> per_plane;   // #Scene::blockers: links for which it is the first plane
    double seconds = 0;                 // for links cut one by one, and the warnings; pairs that a
                                        // plane parts are dropped as the links are made
    std::vector<std::string> warnings;  // of planes that cut links with nothing else in their way
};

// Sets the form factor of each link that crosses a plane to 0, and counts it. Links of separated
// pairs count as refine_links() says. `links` are those of `tree`.
[[nodiscard]] BlockerCuts cut_by_blockers(const Scene& scene, const PatchTree& tree,
                                          const RayScene& rays, const BlockingPlanes& planes,
                                          RefinedLinks& links, Progress& progress);

}  // namespace antiradiance
