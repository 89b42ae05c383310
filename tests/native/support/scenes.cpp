// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/scenes.h"

#include <array>
#include <vector>

namespace antiradiance::test {

int add_material(Scene& scene, const vec3& albedo, const vec3& emission) {
    Material m;
    m.name = "Material " + std::to_string(scene.materials.size());
    m.albedo = albedo;
    m.emission = emission;
    scene.materials.push_back(m);
    return static_cast<int>(scene.materials.size()) - 1;
}

namespace {
void add(Scene& scene, const std::vector<vec3>& positions, const std::vector<uvec3>& triangles,
         const std::vector<std::int32_t>& polygons, int material, const std::string& name) {
    MeshInput mesh;
    mesh.object_name = name;
    mesh.positions = positions.data();
    mesh.position_count = positions.size();
    mesh.triangles = triangles.data();
    mesh.triangle_count = triangles.size();
    mesh.triangle_polygon = polygons.data();
    mesh.slot_materials = {material};
    add_mesh(scene, mesh);
}
}  // namespace

void add_quad(Scene& scene, const vec3& a, const vec3& b, const vec3& c, const vec3& d,
              int material, const std::string& name) {
    add(scene, {a, b, c, d}, {{0, 1, 2}, {0, 2, 3}}, {0, 0}, material, name);
}

void add_triangle(Scene& scene, const vec3& a, const vec3& b, const vec3& c, int material,
                  const std::string& name) {
    add(scene, {a, b, c}, {{0, 1, 2}}, {0}, material, name);
}

void add_box(Scene& scene, const vec3& low, const vec3& high, int material, bool inward,
             const std::string& name) {
    std::vector<vec3> p;
    for (int i = 0; i < 8; ++i)
        p.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    // Counter-clockwise seen from outside.
    constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    std::vector<uvec3> triangles;
    std::vector<std::int32_t> polygons;
    for (std::size_t f = 0; f < kFaces.size(); ++f) {
        auto [a, b, c, d] = kFaces[f];
        if (inward) std::swap(b, d);
        triangles.emplace_back(a, b, c);
        triangles.emplace_back(a, c, d);
        polygons.insert(polygons.end(), 2, static_cast<std::int32_t>(f));
    }
    add(scene, p, triangles, polygons, material, name);
}

}  // namespace antiradiance::test
