// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/obj_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "scene/validate.h"
#include "tools/picture_file.h"

namespace antiradiance {
namespace {

namespace fs = std::filesystem;

// Files in a folder of the running test's own.
class ObjScene : public testing::Test {
protected:
    ObjScene() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::path(ANTIRADIANCE_BINARY_DIR) / "test-files" / test->test_suite_name() /
                  test->name();
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return (folder_ / name).string();
    }

    [[nodiscard]] Scene read(const std::string& text, float scale = 1) const {
        return read_obj(write("scene.obj", text), scale);
    }

    // The problems of a scene that names everything that is wrong with it, one a line.
    [[nodiscard]] std::string problems_of(const std::string& text) const {
        Scene scene = read(text);
        try {
            validate(scene);
        } catch (const SceneError& error) {
            return error.what();
        }
        return "";
    }

    fs::path folder_;
};

constexpr const char* kSquare =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

vec3 area_of(const Scene& scene, TriangleId t) {
    const auto c = scene.corners(t);
    return 0.5F * glm::cross(c[1] - c[0], c[2] - c[0]);
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST_F(ObjScene, keeps_quads_and_larger_polygons_together) {
    const Scene scene = read(std::string(kSquare) +
                             "v 0.5 2 0\n"
                             "f 1 2 3 4\n"
                             "f 1 2 3 5 4\n"
                             "f 1 2 3\n");
    ASSERT_EQ(scene.triangles.size(), 6U);
    EXPECT_EQ(scene.triangle_polygon, (std::vector<std::int32_t>{0, 0, 1, 1, 1, 2}));
    EXPECT_EQ(scene.polygon_count, 3);
    for (TriangleId t = 0; t < 6; ++t)
        EXPECT_GT(area_of(scene, t).z, 0);
    EXPECT_TRUE(scene.problems.empty());
}

TEST_F(ObjScene, takes_polygons_of_any_size) {
    std::ostringstream vertices;
    std::ostringstream face;
    constexpr int kCorners = 300;
    for (int i = 0; i < kCorners; ++i) {
        const float angle = 2 * kPi * static_cast<float>(i) / kCorners;
        vertices << "v " << std::cos(angle) << " " << std::sin(angle) << " 0\n";
        face << " " << i + 1;
    }
    const Scene scene = read(vertices.str() + "f" + face.str() + "\n");
    ASSERT_EQ(scene.triangles.size(), kCorners - 2U);
    EXPECT_EQ(scene.polygon_count, 1);
    float area = 0;
    for (TriangleId t = 0; t < kCorners - 2; ++t)
        area += area_of(scene, t).z;
    EXPECT_NEAR(area, kPi, 1e-3F);
}

TEST_F(ObjScene, counts_negative_indices_from_the_last_one_so_far) {
    const Scene scene = read(
        "v 9 9 9\n"
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.5\n"
        "f -3/-1 -2/-1 -1/-1\n"
        "v 0 0 5\nv 1 0 5\nv 0 1 5\n"
        "f -3 -2 -1\n");
    ASSERT_EQ(scene.triangles.size(), 2U);
    EXPECT_EQ(scene.corners(0)[1], vec3(1, 0, 0));
    EXPECT_EQ(scene.uv[0][2], vec2(0.25F, 0.5F));
    EXPECT_EQ(scene.corners(1)[2], vec3(0, 1, 5));
}

TEST_F(ObjScene, lets_faces_name_vertices_further_down) {
    const Scene scene = read("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n");
    EXPECT_TRUE(scene.problems.empty());
    EXPECT_EQ(scene.triangles.size(), 1U);
}

TEST_F(ObjScene, takes_every_form_of_corner) {
    const Scene scene = read(std::string(kSquare) +
                             "vn 0 0.6 0.8\n"
                             "f 1 2 3\n"
                             "f 1/1 2/2 3/3\n"
                             "f 1//1 2//1 3//1\n"
                             "f 1/1/1 2/2/1 3/3/1\n");
    ASSERT_EQ(scene.triangles.size(), 4U);
    const vec2 none(0);
    const vec2 given(1, 1);
    EXPECT_EQ(scene.uv[0][2], none);
    EXPECT_EQ(scene.uv[1][2], given);
    EXPECT_EQ(scene.uv[2][2], none);
    EXPECT_EQ(scene.uv[3][2], given);
    EXPECT_EQ(scene.normals[0][0], vec3(0, 0, 1)) << "flat where the file gives none";
    EXPECT_EQ(scene.normals[2][0], vec3(0, 0.6F, 0.8F));
}

TEST_F(ObjScene, makes_objects_of_o_and_g) {
    const Scene scene = read(std::string(kSquare) +
                             "f 1 2 3\n"
                             "o Room \nf 1 2 3 4\n"
                             "g floor wood\nf 1 2 3\n"
                             "g walls\nf 1 2 3\nf 1 3 4\n"
                             "o Room\nf 1 3 4\n"
                             "o Empty\n");
    std::vector<std::string> names;
    std::vector<int> counts;
    for (const Object& object : scene.objects) {
        names.push_back(object.name);
        counts.push_back(object.triangle_count);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"scene", "Room", "Room/floor wood", "Room/walls"}));
    EXPECT_EQ(counts, (std::vector<int>{1, 3, 1, 2}));
}

TEST_F(ObjScene, scales_to_metres) {
    const Scene scene = read("v 0 0 0\nv 100 0 0\nv 0 100 0\nvn 0 0 1\nf 1//1 2//1 3//1\n", 0.01F);
    EXPECT_EQ(scene.corners(0)[1], vec3(1, 0, 0));
    EXPECT_EQ(scene.normals[0][0], vec3(0, 0, 1));
}

TEST_F(ObjScene, reads_files_from_windows_and_continued_lines) {
    const Scene scene = read(
        "# C:\\models\\\r\n"
        "v 0 0 0\r\nv 1 0 0\r\n  v 1 \\\r\n 1 0\r\nv 0 1 0\r\nf 1 2 \\\r\n3 4");
    EXPECT_TRUE(scene.problems.empty());
    ASSERT_EQ(scene.triangles.size(), 2U);
    EXPECT_EQ(scene.corners(0)[2], vec3(1, 1, 0));
}

TEST_F(ObjScene, reads_materials) {
    write("m.mtl",
          "newmtl red\nKd 0.8 0.1 0.2\n\n"
          "newmtl lamp \nKd 0 0 0\nKe 5 4 3\n"
          "newmtl unused\nmap_Kd nowhere.png\n");
    const Scene scene = read(std::string("mtllib m.mtl\n") + kSquare +
                             "f 1 2 4\n"
                             "usemtl lamp\nf 1 2 3\n"
                             "usemtl red\nf 1 3 4\n");
    ASSERT_TRUE(scene.problems.empty()) << scene.problems.front();
    const auto material = [&](std::size_t t) {
        return scene.materials[static_cast<std::size_t>(scene.triangle_material[t])];
    };
    EXPECT_EQ(material(0).albedo, vec3(0.8F)) << "grey where the file says nothing";
    EXPECT_EQ(material(1).name, "lamp");
    EXPECT_EQ(material(1).emission, vec3(5, 4, 3));
    EXPECT_EQ(material(2).albedo, vec3(0.8F, 0.1F, 0.2F));
}

TEST_F(ObjScene, reads_all_material_files) {
    write("a.mtl", "newmtl a\nKd 0.1 0.1 0.1\n");
    write("b.mtl", "newmtl b\nKd 0.2 0.2 0.2\n");
    write("with space.mtl", "newmtl c\nKd 0.3 0.3 0.3\n");
    const Scene scene = read(std::string(kSquare) +
                             "mtllib a.mtl b.mtl\nmtllib with space.mtl\n"
                             "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n");
    ASSERT_TRUE(scene.problems.empty()) << scene.problems.front();
    EXPECT_EQ(scene.materials.back().albedo, vec3(0.3F));
}

TEST_F(ObjScene, reads_textures_beside_the_material_file) {
    fs::create_directories(folder_ / "textures");
    // Linear 0.25, 0.5, 1 below and 0 above, as .exr keeps them.
    Picture picture;
    picture.width = 1;
    picture.height = 2;
    picture.combined = {vec4(0.25F, 0.5F, 1, 1), vec4(0, 0, 0, 1)};
    PictureFile((folder_ / "textures" / "two.exr").string()).write(picture);
    PictureFile((folder_ / "textures" / "two.png").string()).write(picture);
    write("m.mtl",
          "newmtl wall\nKd 0.5 0.5 0.5\nmap_Kd textures\\two.exr\n"
          "newmtl screen\nKd 0 0 0\nmap_Ke textures/two.png\n");
    const Scene scene = read(std::string("mtllib m.mtl\n") + kSquare +
                             "usemtl wall\nf 1/1 2/2 3/3\nusemtl screen\nf 1/1 2/2 3/3\n");
    ASSERT_TRUE(scene.problems.empty()) << scene.problems.front();
    ASSERT_EQ(scene.textures.size(), 2U);
    const vec2 below(0.75F, 0.25F);  // of the triangle: uv (1, 0.25), the lower pixel's centre
    const vec3 albedo = scene.albedo_at(0, below);
    const vec3 emission = scene.emission_at(1, below);
    for (int c = 0; c < 3; ++c) {
        const float value = 0.25F * static_cast<float>(1 << c);
        EXPECT_NEAR(albedo[c], 0.5F * value, 1e-3F) << "map_Kd times Kd";
        EXPECT_NEAR(emission[c], value, 5e-3F) << "map_Ke alone, decoded from sRGB";
    }
}

TEST_F(ObjScene, lists_all_problems_at_once) {
    write("m.mtl", "newmtl wood\nKd 0.5 nan 0.5\nmap_Kd gone.png\n");
    const std::string problems = problems_of(std::string("mtllib m.mtl\n") + kSquare +
                                             "v 0 nan 0\nv 1 2\nv inf 1 1\nv 1e99 0 0\n"
                                             "o Table\nusemtl wood\nf 1 2 3\nf 1 2 77\nf 0 1 2\n"
                                             "o Chair\nusemtl glass\nf 1/9 2/9 3/9\nf 1 2 -50\n");
    for (const char* part :
         {"line 10: 'v' needs 3 finite numbers, but has '0 nan 0'", "line 11: 'v'", "line 12: 'v'",
          "line 13: 'v'", "m.mtl', line 2: 'Kd' needs 3 finite numbers",
          "The material 'glass' is in none of the material files", "Material 'wood'", "gone.png",
          "Object 'Table': 2 faces have corners that name vertices",
          "Object 'Chair': 2 faces have corners"})
        EXPECT_TRUE(contains(problems, part)) << part << "\nis not in\n" << problems;
}

TEST_F(ObjScene, names_the_missing_material_file_only) {
    const std::string problems =
        problems_of(std::string("mtllib gone.mtl\n") + kSquare + "usemtl wood\nf 1 2 3\n");
    EXPECT_TRUE(contains(problems, "line 1: the material file '")) << problems;
    EXPECT_TRUE(contains(problems, "gone.mtl' can't be read: No such file")) << problems;
    EXPECT_FALSE(contains(problems, "wood")) << problems;
}

TEST_F(ObjScene, a_broken_texture_is_a_problem) {
    write("noise.png", "this is no picture");
    write("m.mtl", "newmtl wood\nmap_Kd noise.png\n");
    const std::string problems =
        problems_of(std::string("mtllib m.mtl\n") + kSquare + "usemtl wood\nf 1 2 3\n");
    EXPECT_TRUE(contains(problems, "noise.png' can't be read: ")) << problems;
}

TEST_F(ObjScene, a_file_without_faces_is_a_problem) {
    EXPECT_TRUE(contains(problems_of(""), "holds no faces"));
    EXPECT_TRUE(contains(problems_of(kSquare), "holds no faces"));
    EXPECT_TRUE(contains(problems_of(std::string("\0\xff\x7f\x45LF\n\n\0", 9)), "holds no faces"));
}

TEST_F(ObjScene, a_file_that_cannot_be_read_says_why) {
    const auto message_of = [](const std::string& path) -> std::string {
        try {
            (void)read_obj(path, 1);
        } catch (const SceneError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_TRUE(contains(message_of((folder_ / "gone.obj").string()), "No such file"));
    EXPECT_TRUE(contains(message_of(folder_.string()), "it is a folder"));
}

TEST_F(ObjScene, warns_of_what_it_leaves_out) {
    write("m.mtl", "newmtl glass\nKd 1 1 1\nd 0.2\n");
    const Scene scene =
        read(std::string("mtllib m.mtl\n") + kSquare + "usemtl glass\nf 1 2 3\nf 1 2\n");
    ASSERT_EQ(scene.warnings.size(), 2U);
    EXPECT_TRUE(contains(scene.warnings[0], "Material 'glass': it is transparent"));
    EXPECT_TRUE(contains(scene.warnings[1], "1 face has less than three corners"));
}

}  // namespace
}  // namespace antiradiance
