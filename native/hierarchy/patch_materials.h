// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "hierarchy/patch_tree.h"
#include "scene/scene.h"

namespace antiradiance {

// Area averages. Not part of the tree, which outlives a change of colours.
struct PatchMaterials {
    std::vector<vec3> albedo;    // #nodes, 0..1
    std::vector<vec3> emission;  // #nodes, W/(m2 sr)
};

// scene: the one that the tree was made of, or one that differs from it in materials, textures and
// the power of lamps only.
[[nodiscard]] PatchMaterials average_materials(const Scene& scene, const PatchTree& tree);

}  // namespace antiradiance
