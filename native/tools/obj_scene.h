// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "scene/scene.h"

namespace antiradiance {

// Reads a Wavefront OBJ file and the MTL files that it names into a scene without lamps or camera.
// Polygons keep together as Scene::triangle_polygon; an `o` or `g` statement begins an object, and
// one of a name that was there before goes on with it. Faces without a material get a grey one.
//
// scale: metres a unit of the file; axes stay as they are.
// What is wrong with the file, MTL files and textures included, is left in Scene::problems, all of
// it, for validate() to throw. Throws SceneError when the OBJ file itself can't be read.
Scene read_obj(const std::string& path, float scale);

}  // namespace antiradiance
