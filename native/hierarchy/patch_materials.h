// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hierarchy/patch_tree.h"
#include "scene/scene.h"

namespace antiradiance {

// Fills PatchTree::albedo and emission from the scene that the tree was made of, or one that
// differs from it in materials, textures and the power of lamps only.
void average_materials(const Scene& scene, PatchTree& tree);

}  // namespace antiradiance
