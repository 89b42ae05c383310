// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "hierarchy/patch_tree.h"
#include "scene/ray_scene.h"

namespace antiradiance {

// Finds leaves that lie inside of other solids (a floor under a block, the end of a wall): 4 x 4
// points a leaf, up to 4 rays each; a point whose rays end on unlit sides lies inside a solid.
// Fills PatchTree::exposed and exposed_mask. Such a patch neither emits nor reflects from its
// hidden part; left alone it leaks light and makes the antiradiance solve diverge (algorithm.md "It
// can diverge"). Returns a warning that names the objects when more than a little is hidden.
std::vector<std::string> find_buried_patches(const Scene& scene, const RayScene& rays,
                                             PatchTree& tree, Progress& progress);

}  // namespace antiradiance
