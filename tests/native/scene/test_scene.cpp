// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/scene.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/validate.h"
#include "support/scene_builder.h"

namespace antiradiance {
namespace {

vec3 geometric_normal(const Scene& scene, TriangleId t) {
    const auto c = scene.corners(t);
    return glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
}

Texture checker() {
    Texture t;
    t.name = "checker";
    t.width = 2;
    t.height = 2;
    // Row 0 is below.
    t.pixels = {vec4(0, 0, 0, 1), vec4(1, 0, 0, 1), vec4(0, 1, 0, 1), vec4(0, 0, 1, 1)};
    return t;
}

TEST(add_mesh, moves_positions_to_the_world_row_by_row) {
    Scene scene;
    mat4 m = glm::translate(mat4(1), vec3(1, 2, 3));
    m = glm::scale(m, vec3(2, 1, 1));
    test::add_polygon(scene, "a", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, kNone, {}, m);
    EXPECT_EQ(scene.positions[1], vec3(3, 2, 3));
    EXPECT_EQ(scene.positions[2], vec3(1, 3, 3));
}

TEST(add_mesh, keeps_the_front_of_a_mirrored_mesh) {
    Scene scene;
    const std::vector<vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};  // front: +z
    test::add_polygon(scene, "mirrored in x", corners, kNone, {},
                      glm::scale(mat4(1), vec3(-1, 1, 1)));
    test::add_polygon(scene, "mirrored in z", corners, kNone, {},
                      glm::scale(mat4(1), vec3(1, 1, -1)));
    EXPECT_NEAR(geometric_normal(scene, 0).z, 1, 1e-6F);
    EXPECT_NEAR(geometric_normal(scene, 1).z, -1, 1e-6F);
    EXPECT_NEAR(scene.shading_normal_at(1, vec2(0.3F, 0.3F)).z, -1, 1e-6F);
}

TEST(add_mesh, keeps_uv_and_normals_at_their_corners_when_mirrored) {
    Scene scene;
    const std::vector<vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<uvec3> triangles{{0, 1, 2}};
    const std::array<vec2, 3> uv{vec2(0, 0), vec2(1, 0), vec2(0, 1)};
    const std::array<vec3, 3> normals{vec3(0, 0, 1), vec3(1, 0, 1), vec3(0, 1, 1)};
    MeshInput mesh;
    mesh.positions = positions.data();
    mesh.position_count = 3;
    mesh.triangles = triangles.data();
    mesh.triangle_count = 1;
    mesh.uv = &uv;
    mesh.normals = &normals;
    mesh.to_world = glm::scale(mat4(1), vec3(-1, 1, 1));
    add_mesh(scene, mesh);
    for (std::size_t i = 0; i < 3; ++i) {
        const vec3 p = scene.positions[scene.triangles[0][static_cast<int>(i)]];
        EXPECT_EQ(scene.uv[0][i], vec2(-p.x, p.y));
        const vec3 expected = glm::normalize(vec3(p.x, p.y, 1));
        EXPECT_NEAR(glm::distance(scene.normals[0][i], expected), 0, 1e-6F);
    }
}

TEST(add_mesh, normals_stay_perpendicular_under_uneven_scale) {
    Scene scene;
    const vec3 a(1, 0, 0);
    const vec3 b(0, 1, 1);
    const std::vector<vec3> positions{vec3(0), a, b};
    const std::vector<uvec3> triangles{{0, 1, 2}};
    const vec3 n = glm::normalize(glm::cross(a, b));
    const std::array<vec3, 3> normals{n, n, n};
    MeshInput mesh;
    mesh.positions = positions.data();
    mesh.position_count = 3;
    mesh.triangles = triangles.data();
    mesh.triangle_count = 1;
    mesh.normals = &normals;
    mesh.to_world = glm::scale(mat4(1), vec3(1, 1, 10));
    add_mesh(scene, mesh);
    EXPECT_NEAR(glm::distance(scene.normals[0][0], geometric_normal(scene, 0)), 0, 1e-6F);
}

TEST(add_mesh, polygons_of_two_meshes_differ) {
    Scene scene;
    test::add_quad(scene, "a", vec3(0), vec3(1, 0, 0), vec3(0, 1, 0), kNone);
    test::add_quad(scene, "b", vec3(0, 0, 1), vec3(1, 0, 0), vec3(0, 1, 0), kNone);
    EXPECT_EQ(scene.triangle_polygon, (std::vector<std::int32_t>{0, 0, 1, 1}));
    EXPECT_EQ(scene.object_name(3), "b");
}

TEST(add_mesh, a_slot_without_a_material_is_grey) {
    Scene scene;
    test::add_material(scene, vec3(1, 0, 0));
    test::add_polygon(scene, "a", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, kNone);
    EXPECT_EQ(scene.albedo_at(0, vec2(0.2F)), vec3(0.8F));
}

TEST(Texture, interpolates_and_repeats) {
    const Texture t = checker();
    EXPECT_EQ(vec3(t.sample({0.25F, 0.25F})), vec3(0, 0, 0));  // centre of the first pixel
    EXPECT_EQ(vec3(t.sample({0.75F, 0.25F})), vec3(1, 0, 0));
    EXPECT_EQ(vec3(t.sample({0.25F, 0.75F})), vec3(0, 1, 0));
    EXPECT_EQ(vec3(t.sample({0.5F, 0.25F})), vec3(0.5F, 0, 0));
    EXPECT_EQ(vec3(t.sample({1.75F, -2.75F})), vec3(1, 0, 0));
    EXPECT_EQ(vec3(t.sample({0.0F, 0.25F})), vec3(0.5F, 0, 0));  // half of each neighbour
    EXPECT_EQ(vec3(t.sample({std::nanf(""), 0})), vec3(0));
}

TEST(Scene, texture_multiplies_the_constant) {
    Scene scene;
    scene.textures.push_back(checker());
    const int m = test::add_material(scene, vec3(0.5F), vec3(2, 2, 2));
    scene.materials[static_cast<std::size_t>(m)].albedo_texture = 0;
    scene.materials[static_cast<std::size_t>(m)].emission_texture = 0;
    test::add_quad(scene, "a", vec3(0), vec3(1, 0, 0), vec3(0, 1, 0), m);
    // First triangle: corners (0,0), (1,0), (1,1) of the square; the point is (0.75, 0.25).
    EXPECT_EQ(scene.albedo_at(0, {0.5F, 0.25F}), vec3(0.5F, 0, 0));
    EXPECT_EQ(scene.emission_at(0, {0.5F, 0.25F}), vec3(2, 0, 0));
}

TEST(Scene, extent_grows_with_the_distance_from_the_origin) {
    const auto extent_at = [](float x) {
        Scene scene;
        test::add_quad(scene, "a", {x, 0, 0}, {2, 0, 0}, {0, 1, 0},
                       test::add_material(scene, vec3(0.5F)));
        scene.positions.emplace_back(1e6F, 0, 0);  // of no triangle
        return largest_extent(scene);
    };
    EXPECT_EQ(extent_at(0), 2);
    EXPECT_EQ(extent_at(-998), 0.05F * 998);
    EXPECT_EQ(largest_extent({}), 1);
}

}  // namespace
}  // namespace antiradiance
