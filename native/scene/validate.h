// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace antiradiance {

// Checks a scene and repairs what can be rendered all the same, in place: drops zero-area and
// duplicate triangles (same corners, whichever order) and clamps albedos above 1, each with a
// warning that names the object or material (one line an object, with counts).
// A blocker that cuts nothing, for want of faces or of area, is a warning as well.
// Throws SceneError with every problem that leaves no honest picture: no geometry, NaN or infinite
// coordinates, a matrix that can't be inverted, a missing texture.
// Returns the warnings, Scene::warnings first.
std::vector<std::string> validate(Scene& scene);

}  // namespace antiradiance
