// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/validate.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "base/error.h"
#include "support/scene_builder.h"

namespace antiradiance {
namespace {

const std::vector<vec3> kTriangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

std::string error_of(Scene& scene) {
    try {
        validate(scene);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(validate, accepts_a_good_scene_without_a_word) {
    Scene scene;
    test::add_quad(scene, "floor", vec3(0), vec3(1, 0, 0), vec3(0, 1, 0), kNone);
    EXPECT_TRUE(validate(scene).empty());
    EXPECT_EQ(scene.triangles.size(), 2U);
}

TEST(validate, keeps_the_warnings_of_the_caller_first) {
    Scene scene;
    scene.warnings = {"from sync"};
    test::add_polygon(scene, "bad", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, kNone);
    test::add_polygon(scene, "good", kTriangle, kNone);
    const auto warnings = validate(scene);
    ASSERT_EQ(warnings.size(), 2U);
    EXPECT_EQ(warnings[0], "from sync");
}

TEST(validate, refuses_an_empty_scene) {
    Scene scene;
    EXPECT_TRUE(contains(error_of(scene), "no faces to render"));
}

TEST(validate, names_every_object_that_is_broken) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    Scene scene;
    test::add_polygon(scene, "with nan", {{0, 0, nan}, {1, 0, 0}, {0, 1, 0}}, kNone);
    test::add_polygon(scene, "with inf", {{0, 0, 0}, {inf, 0, 0}, {0, 1, 0}}, kNone);
    test::add_polygon(scene, "far out", {{0, 0, 0}, {1e20F, 0, 0}, {0, 1, 0}}, kNone);
    test::add_polygon(scene, "flattened", kTriangle, kNone, {}, glm::scale(mat4(1), vec3(1, 1, 0)));
    test::add_polygon(scene, "nan matrix", kTriangle, kNone, {}, mat4(nan));
    test::add_polygon(scene, "good", kTriangle, kNone);
    const std::string error = error_of(scene);
    for (const char* name : {"with nan", "with inf", "far out", "flattened", "nan matrix"}) {
        EXPECT_TRUE(contains(error, name)) << error;
    }
    EXPECT_FALSE(contains(error, "good"));
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 4) << error;
}

TEST(validate, a_tiny_or_stretched_object_is_not_singular) {
    Scene scene;
    test::add_polygon(scene, "tiny", kTriangle, kNone, {}, glm::scale(mat4(1), vec3(1e-4F)));
    test::add_polygon(scene, "stretched", kTriangle, kNone, {},
                      glm::scale(mat4(1), vec3(1e3F, 1e-3F, 1)));
    EXPECT_EQ(error_of(scene), "");
    EXPECT_EQ(scene.triangles.size(), 2U);
}

TEST(validate, drops_zero_area_triangles_with_a_count) {
    Scene scene;
    test::add_polygon(scene, "bad", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, kNone);
    test::add_polygon(scene, "good", kTriangle, kNone);
    const auto warnings = validate(scene);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_TRUE(contains(warnings[0], "Object 'bad': 1 zero-area triangle was")) << warnings[0];
    ASSERT_EQ(scene.triangles.size(), 1U);
    EXPECT_EQ(scene.object_name(0), "good");
    EXPECT_EQ(scene.objects[0].triangle_count, 0);
    EXPECT_EQ(scene.objects[1].first_triangle, 0);
    EXPECT_EQ(scene.objects[1].triangle_count, 1);
    EXPECT_EQ(scene.uv.size(), 1U);
    EXPECT_EQ(scene.normals.size(), 1U);
}

TEST(validate, a_face_of_nothing_but_zero_area_is_no_geometry) {
    Scene scene;
    test::add_polygon(scene, "bad", {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, kNone);
    EXPECT_TRUE(contains(error_of(scene), "no faces to render"));
}

TEST(validate, drops_duplicates_whatever_their_order) {
    Scene scene;
    const std::vector<vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-0.0F, 0, 0}};
    const std::vector<uvec3> triangles{{0, 1, 2}, {1, 2, 4}, {2, 1, 0}, {0, 1, 3}};
    MeshInput mesh;
    mesh.object_name = "doubled";
    mesh.positions = positions.data();
    mesh.position_count = positions.size();
    mesh.triangles = triangles.data();
    mesh.triangle_count = triangles.size();
    add_mesh(scene, mesh);
    const auto warnings = validate(scene);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_TRUE(contains(warnings[0], "Object 'doubled': 2 duplicate triangles")) << warnings[0];
    EXPECT_EQ(scene.triangle_polygon, (std::vector<std::int32_t>{0, 3}));
}

TEST(validate, names_both_objects_of_a_coincident_pair) {
    Scene scene;
    test::add_polygon(scene, "first", kTriangle, kNone);
    test::add_polygon(scene, "second", kTriangle, kNone);
    const auto warnings = validate(scene);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_TRUE(contains(warnings[0], "'first'") && contains(warnings[0], "'second'"));
    ASSERT_EQ(scene.triangles.size(), 1U);
    EXPECT_EQ(scene.object_name(0), "first");
}

TEST(validate, clamps_albedo_and_names_material_and_object) {
    Scene scene;
    const int m = test::add_material(scene, vec3(1.5F, 0.5F, -0.1F));
    test::add_polygon(scene, "wall", kTriangle, m);
    const auto warnings = validate(scene);
    ASSERT_EQ(warnings.size(), 2U);  // above 1, and below 0
    EXPECT_TRUE(contains(warnings[1], "'wall'") && contains(warnings[1], "'material 0'"));
    EXPECT_EQ(scene.materials[0].albedo, vec3(1, 0.5F, 0));
}

TEST(validate, a_missing_texture_names_object_material_and_path) {
    Scene scene;
    Texture missing;
    missing.name = "bricks";
    missing.missing_path = "/nowhere/bricks.png";
    scene.textures.push_back(missing);
    const int m = test::add_material(scene, vec3(1));
    scene.materials[0].albedo_texture = 0;
    test::add_polygon(scene, "wall", kTriangle, m);
    const std::string error = error_of(scene);
    EXPECT_TRUE(contains(error, "'wall'") && contains(error, "'material 0'") &&
                contains(error, "/nowhere/bricks.png"))
        << error;
}

TEST(validate, a_missing_texture_that_nobody_shows_is_no_error) {
    Scene scene;
    scene.textures.emplace_back().missing_path = "/nowhere";
    test::add_material(scene, vec3(1));
    scene.materials[0].albedo_texture = 0;
    const int other = test::add_material(scene, vec3(1));
    test::add_polygon(scene, "wall", kTriangle, other);
    EXPECT_EQ(error_of(scene), "");
}

TEST(validate, lamps) {
    Scene scene;
    test::add_polygon(scene, "floor", kTriangle, kNone);
    Lamp broken{.name = "broken", .power = vec3(std::numeric_limits<float>::infinity())};
    Lamp flat{.name = "flat",
              .type = LampType::kArea,
              .to_world = glm::scale(mat4(1), vec3(0, 1, 1)),
              .power = vec3(1)};
    Lamp sizeless{.name = "sizeless", .type = LampType::kArea, .power = vec3(1), .size = vec2(0)};
    scene.lamps = {broken, flat, sizeless};
    const std::string error = error_of(scene);
    EXPECT_TRUE(contains(error, "'broken'") && contains(error, "'flat'")) << error;
    EXPECT_FALSE(contains(error, "'sizeless'")) << error;
    scene.lamps = {sizeless};
    const auto warnings = validate(scene);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_TRUE(contains(warnings[0], "'sizeless'"));
}

TEST(validate, indices_beyond_the_vertices_are_an_error_not_a_crash) {
    Scene scene;
    const std::vector<uvec3> triangles{{0, 1, 7}};
    MeshInput mesh;
    mesh.object_name = "corrupt";
    mesh.positions = kTriangle.data();
    mesh.position_count = 3;
    mesh.triangles = triangles.data();
    mesh.triangle_count = 1;
    add_mesh(scene, mesh);
    EXPECT_TRUE(contains(error_of(scene), "'corrupt'"));
}

Scene floor_scene() {
    Scene scene;
    test::add_quad(scene, "floor", vec3(0), vec3(1, 0, 0), vec3(0, 1, 0), kNone);
    return scene;
}

TEST(validate, accepts_a_blocker_flattened_along_its_normal) {
    Scene scene = floor_scene();
    MeshInput mesh;
    mesh.object_name = "flat";
    mesh.positions = kTriangle.data();
    mesh.position_count = kTriangle.size();
    const uvec3 triangle(0, 1, 2);
    mesh.triangles = &triangle;
    mesh.triangle_count = 1;
    mesh.to_world = glm::scale(mat4(1), vec3(2, 3, 0));
    add_blocker(scene, mesh);
    EXPECT_TRUE(validate(scene).empty());
    ASSERT_EQ(scene.blockers.size(), 1U);
    EXPECT_EQ(scene.blockers[0].positions[1], vec3(2, 0, 0)) << "in world space";
}

TEST(validate, warns_of_blockers_that_cut_nothing) {
    Scene scene = floor_scene();
    scene.blockers.push_back({"without faces", {vec3(0), vec3(1)}, {}});
    test::add_plane(scene, "without area", vec3(0), vec3(1, 0, 0), vec3(0));
    const auto warnings = validate(scene);
    ASSERT_EQ(warnings.size(), 2U);
    EXPECT_TRUE(contains(warnings[0], "'without faces': it has no faces and cuts nothing"));
    EXPECT_TRUE(contains(warnings[1], "'without area': its faces have no area"));
    EXPECT_TRUE(scene.blockers[1].triangles.empty());
}

TEST(validate, names_every_blocker_that_is_broken) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Scene scene = floor_scene();
    test::add_plane(scene, "with nan", vec3(nan), vec3(1, 0, 0), vec3(0, 1, 0));
    test::add_plane(scene, "far out", vec3(1e20F), vec3(1, 0, 0), vec3(0, 1, 0));
    MeshInput mesh;
    mesh.object_name = "nan matrix";
    mesh.to_world = mat4(nan);
    add_blocker(scene, mesh);
    mesh.object_name = "broken";
    mesh.to_world = mat4(1);
    const uvec3 triangle(0, 1, 2);
    mesh.triangles = &triangle;
    mesh.triangle_count = 1;
    add_blocker(scene, mesh);
    const std::string error = error_of(scene);
    for (const char* name : {"'with nan'", "'far out'", "'nan matrix'", "'broken'"})
        EXPECT_TRUE(contains(error, name)) << name << " in " << error;
}

TEST(validate, says_when_a_blocker_is_the_only_geometry) {
    Scene scene;
    test::add_plane(scene, "Wall", vec3(0), vec3(1, 0, 0), vec3(0, 1, 0));
    EXPECT_TRUE(contains(error_of(scene), "besides those of the blocking plane 'Wall'"));
}

}  // namespace
}  // namespace antiradiance
