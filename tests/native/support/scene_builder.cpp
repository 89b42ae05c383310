// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/scene_builder.h"

#include <cmath>

#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

namespace antiradiance::test {

int add_material(Scene& scene, const vec3& albedo, const vec3& emission) {
    scene.materials.push_back({.name = "material " + std::to_string(scene.materials.size()),
                               .albedo = albedo,
                               .emission = emission});
    return static_cast<int>(scene.materials.size()) - 1;
}

void add_polygon(Scene& scene, const std::string& name, const std::vector<vec3>& corners,
                 int material, const std::vector<vec2>& uvs, const mat4& to_world) {
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

void add_quad(Scene& scene, const std::string& name, const vec3& corner, const vec3& a,
              const vec3& b, int material) {
    add_polygon(scene, name, {corner, corner + a, corner + a + b, corner + b}, material,
                {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
}

void add_box(Scene& scene, const std::string& name, const vec3& low, const vec3& high, int material,
             Facing facing) {
    std::vector<vec3> positions;
    for (int i = 0; i < 8; ++i) {
        positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y,
                               i & 4 ? high.z : low.z);
    }
    // Counter-clockwise seen from outside.
    constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    std::vector<uvec3> triangles;
    std::vector<std::int32_t> polygons;
    for (std::size_t f = 0; f < kFaces.size(); ++f) {
        auto [a, b, c, d] = kFaces[f];
        if (facing == Facing::kInward) std::swap(b, d);
        triangles.emplace_back(a, b, c);
        triangles.emplace_back(a, c, d);
        polygons.insert(polygons.end(), 2, static_cast<std::int32_t>(f));
    }
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

void add_plane(Scene& scene, const std::string& name, const vec3& corner, const vec3& a,
               const vec3& b) {
    const std::array positions{corner, corner + a, corner + a + b, corner + b};
    const std::array triangles{uvec3(0, 1, 2), uvec3(0, 2, 3)};
    MeshInput mesh;
    mesh.object_name = name;
    mesh.positions = positions.data();
    mesh.position_count = positions.size();
    mesh.triangles = triangles.data();
    mesh.triangle_count = triangles.size();
    add_blocker(scene, mesh);
}

void add_ball(Scene& scene, const std::string& name, const vec3& center, float radius, int rings,
              int material) {
    const auto at = [&](int i, int j) {
        const float theta = kPi * static_cast<float>(i) / static_cast<float>(rings);
        const float phi = kPi * static_cast<float>(j) / static_cast<float>(rings);
        return center + radius * vec3(std::sin(theta) * std::cos(phi),
                                      std::sin(theta) * std::sin(phi), std::cos(theta));
    };
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < 2 * rings; ++j) {
            const std::vector<vec3> upper{at(i, j), at(i + 1, j), at(i, j + 1)};
            const std::vector<vec3> lower{at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
            if (i > 0) add_polygon(scene, name, upper, material);
            if (i + 1 < rings) add_polygon(scene, name, lower, material);
        }
    }
}

Lamp lamp_at(LampType type, const vec3& position, float power) {
    Lamp lamp;
    lamp.name = "lamp";
    lamp.type = type;
    lamp.power = vec3(power);
    lamp.to_world = glm::translate(mat4(1), position);
    return lamp;
}

void add_point_lamp(Scene& scene, const vec3& position, const vec3& watts) {
    Lamp lamp = lamp_at(LampType::kPoint, position, 0);
    lamp.name = "lamp " + std::to_string(scene.lamps.size());
    lamp.power = watts;
    scene.lamps.push_back(lamp);
}

}  // namespace antiradiance::test
