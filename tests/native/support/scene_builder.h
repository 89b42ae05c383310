// SPDX-License-Identifier: GPL-3.0-or-later
// Small scenes made in a line or two.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace antiradiance::test {

// Appends a material and returns its number.
int add_material(Scene& scene, const vec3& albedo, const vec3& emission = vec3(0));

// One polygon (fan of triangles), counter-clockwise seen from its front. uv: corner = (x, y) of
// uvs, or none.
void add_polygon(Scene& scene, const std::string& name, const std::vector<vec3>& corners,
                 int material, const std::vector<vec2>& uvs = {}, const mat4& to_world = mat4(1));

// Parallelogram from `corner` along a and b; its front looks along cross(a, b).
void add_quad(Scene& scene, const std::string& name, const vec3& corner, const vec3& a,
              const vec3& b, int material);

// The six faces of an axis-aligned box as one object. kInward: a room, seen from inside.
enum class Facing { kOutward, kInward };
void add_box(Scene& scene, const std::string& name, const vec3& low, const vec3& high, int material,
             Facing facing = Facing::kOutward);

// The parallelogram as a blocking plane.
void add_plane(Scene& scene, const std::string& name, const vec3& corner, const vec3& a,
               const vec3& b);

// A ball of 4 rings (rings - 1) triangles, each an object of its own, fronts outwards.
void add_ball(Scene& scene, const std::string& name, const vec3& center, float radius, int rings,
              int material);

// power: W, of suns W/m2. It shines along -z, where its type has a direction.
[[nodiscard]] Lamp lamp_at(LampType type, const vec3& position, float power);

// Appends a point lamp that sends `watts` into all directions alike.
void add_point_lamp(Scene& scene, const vec3& position, const vec3& watts);

}  // namespace antiradiance::test
