// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace antiradiance {

// Makes `scene` valid (see validate()) and returns what the artist should know of it, that it has
// no light among it. Throws SceneError with all problems at once.
std::vector<std::string> check_scene(Scene& scene);

}  // namespace antiradiance
