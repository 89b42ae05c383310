// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that tests build from a few calls.
#pragma once

#include <string>

#include "scene/scene.h"

namespace antiradiance::test {

// Appends a material and returns its number.
int add_material(Scene& scene, const vec3& albedo, const vec3& emission = vec3(0));

// A quad a, b, c, d, counter-clockwise seen from its front.
void add_quad(Scene& scene, const vec3& a, const vec3& b, const vec3& c, const vec3& d,
              int material, const std::string& name = "Quad");
void add_triangle(Scene& scene, const vec3& a, const vec3& b, const vec3& c, int material,
                  const std::string& name = "Triangle");

// The six faces of an axis-aligned box. inward: a room, else a solid.
void add_box(Scene& scene, const vec3& low, const vec3& high, int material, bool inward,
             const std::string& name = "Box");

}  // namespace antiradiance::test
