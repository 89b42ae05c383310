// SPDX-License-Identifier: GPL-3.0-or-later
// Small scenes made in a line or two.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace antiradiance::test {

inline int add_material(Scene& scene, const vec3& albedo, const vec3& emission = vec3(0)) {
    scene.materials.push_back({.name = "material " + std::to_string(scene.materials.size()),
                               .albedo = albedo,
                               .emission = emission});
    return static_cast<int>(scene.materials.size()) - 1;
}

// One polygon (fan of triangles), counter-clockwise seen from its front. uv: corner = (x, y) of
// uvs, or none.
inline void add_polygon(Scene& scene, const std::string& name, const std::vector<vec3>& corners,
                        int material, const std::vector<vec2>& uvs = {},
                        const mat4& to_world = mat4(1)) {
    std::vector<uvec3> triangles;
    std::vector<std::array<vec2, 3>> uv;
    for (std::uint32_t i = 2; i < corners.size(); ++i) {
        triangles.emplace_back(0, i - 1, i);
        if (!uvs.empty()) uv.push_back({uvs[0], uvs[i - 1], uvs[i]});
    }
    const std::vector<std::int32_t> polygon(triangles.size(), 0);
    MeshInput mesh;
    mesh.object_name = name;
    mesh.positions = corners.data();
    mesh.position_count = corners.size();
    mesh.to_world = to_world;
    mesh.triangles = triangles.data();
    mesh.triangle_count = triangles.size();
    mesh.triangle_polygon = polygon.data();
    mesh.slot_materials = {material};
    if (!uvs.empty()) mesh.uv = uv.data();
    add_mesh(scene, mesh);
}

// Parallelogram from `corner` along a and b; its front looks along cross(a, b).
inline void add_quad(Scene& scene, const std::string& name, const vec3& corner, const vec3& a,
                     const vec3& b, int material) {
    add_polygon(scene, name, {corner, corner + a, corner + a + b, corner + b}, material,
                {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
}

}  // namespace antiradiance::test
