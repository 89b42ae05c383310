// SPDX-License-Identifier: GPL-3.0-or-later
#include "hierarchy/surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>
#include <set>

#include "support/scene_builder.h"

namespace antiradiance {
namespace {

// Triangles of one mesh polygon, as Blender hands them over.
void add_triangles(Scene& scene, const std::vector<vec3>& corners,
                   const std::vector<uvec3>& triangles, const std::vector<std::int32_t>& polygons,
                   int material = 0) {
    MeshInput mesh;
    mesh.object_name = "Mesh";
    mesh.positions = corners.data();
    mesh.position_count = corners.size();
    mesh.triangles = triangles.data();
    mesh.triangle_count = triangles.size();
    mesh.triangle_polygon = polygons.data();
    mesh.slot_materials = {material};
    add_mesh(scene, mesh);
}

float area_of(const std::vector<Polygon>& polygons) {
    return std::accumulate(polygons.begin(), polygons.end(), 0.0F, [](float sum, const Polygon& p) {
        return sum + glm::length(p.area_vector());
    });
}

// Every triangle once; every polygon convex and facing as its triangles do.
void expect_partition(const Scene& scene, const std::vector<Polygon>& polygons) {
    std::set<TriangleId> seen;
    for (const Polygon& p : polygons) {
        for (const TriangleId t : p.triangles) {
            if (t == kNone) continue;
            EXPECT_TRUE(seen.insert(t).second);
            const auto c = scene.corners(t);
            EXPECT_GT(glm::dot(glm::cross(c[1] - c[0], c[2] - c[0]), p.area_vector()), 0);
        }
        for (int i = 0; i < p.corner_count; ++i) {
            const auto at = [&](int k) {
                return p.corners[static_cast<std::size_t>(k % p.corner_count)];
            };
            EXPECT_GT(
                glm::dot(glm::cross(at(i + 1) - at(i), at(i + 2) - at(i + 1)), p.area_vector()), 0);
        }
    }
    EXPECT_EQ(seen.size(), scene.triangles.size());
}

TEST(Polygons, TwoTrianglesOfAQuadAreOnePolygon) {
    Scene scene;
    test::add_material(scene, vec3(0.5F));
    test::add_quad(scene, "Quad", vec3(1), vec3(2, 0, 0), vec3(0.5F, 1, 0), 0);
    const auto polygons = make_polygons(scene);
    ASSERT_EQ(polygons.size(), 1U);
    EXPECT_EQ(polygons[0].corner_count, 4);
    EXPECT_NEAR(area_of(polygons), 2, 1e-5F);
    expect_partition(scene, polygons);
}

TEST(Polygons, ATriangulatedGridIsAGridOfQuadsAgain) {
    Scene scene;
    test::add_material(scene, vec3(0.5F));
    std::vector<vec3> corners;
    std::vector<uvec3> triangles;
    std::vector<std::int32_t> polygons;
    for (std::uint32_t j = 0; j < 5; ++j) {
        for (std::uint32_t i = 0; i < 5; ++i) {
            corners.emplace_back(i, j, 0);
            if (i == 4 || j == 4) continue;
            const std::uint32_t a = 5 * j + i;
            triangles.emplace_back(a, a + 1, a + 6);
            triangles.emplace_back(a, a + 6, a + 5);
            polygons.insert(polygons.end(), 2, static_cast<std::int32_t>(4 * j + i));
        }
    }
    for (const bool known : {true, false}) {  // by the mesh's polygons, or by the longest edges
        if (!known) std::iota(polygons.begin(), polygons.end(), 0);
        Scene grid = scene;
        add_triangles(grid, corners, triangles, polygons);
        const auto quads = make_polygons(grid);
        EXPECT_EQ(quads.size(), 16U) << known;
        for (const Polygon& q : quads)
            EXPECT_NEAR(glm::length(q.area_vector()), 1, 1e-5F);
        expect_partition(grid, quads);
    }
}

TEST(Polygons, ConcavePolygonsAreCutIntoConvexOnes) {
    Scene scene;
    test::add_material(scene, vec3(0.5F));
    // An L of area 3 and an arrow head whose two triangles make no convex quad.
    add_triangles(scene, {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}},
                  {{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}}, {0, 0, 0, 0});
    add_triangles(scene, {{0, 0, 1}, {2, -1, 1}, {0.5F, 0, 1}, {2, 1, 1}}, {{0, 1, 2}, {0, 2, 3}},
                  {0, 0});
    const auto polygons = make_polygons(scene);
    EXPECT_NEAR(area_of(polygons), 3 + 0.5F, 1e-5F);
    expect_partition(scene, polygons);
}

TEST(Polygons, NonPlanarQuadsStayTriangles) {
    for (const float bend : {0.2F, 3.0F, 40.0F}) {  // degrees between the two triangles
        Scene scene;
        test::add_material(scene, vec3(0.5F));
        const float a = glm::radians(bend);
        add_triangles(scene, {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {std::cos(a), 0, std::sin(a)}},
                      {{0, 1, 2}, {0, 3, 1}}, {0, 0});
        const auto polygons = make_polygons(scene);
        // A triangle beside a triangle in one plane has a straight angle here: no quad at all.
        EXPECT_EQ(polygons.size(), 2U) << bend;
        expect_partition(scene, polygons);

        Scene square;
        test::add_material(square, vec3(0.5F));
        const float lift = std::sqrt(0.5F) * std::tan(a);  // of the corner over the diagonal
        add_triangles(square, {{0, 0, 0}, {1, 0, 0}, {1, 1, lift}, {0, 1, 0}},
                      {{0, 1, 3}, {1, 2, 3}}, {0, 0});
        const auto quads = make_polygons(square);
        EXPECT_EQ(quads.size(), bend < 1 ? 1U : 2U) << bend;
        expect_partition(square, quads);
    }
}

TEST(Polygons, ObjectsAndMaterialsStayApart) {
    for (const bool other_object : {false, true}) {
        Scene scene;
        test::add_material(scene, vec3(0.5F));
        test::add_material(scene, vec3(0.2F));
        add_triangles(scene, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}}, {0}, 0);
        add_triangles(scene, {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}}, {0},
                      other_object ? 0 : 1);
        EXPECT_EQ(make_polygons(scene).size(), 2U);
    }
}

TEST(Polygons, JunctionsOfThreeTrianglesStayApart) {
    Scene scene;
    test::add_material(scene, vec3(0.5F));
    add_triangles(scene, {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0.5F, 0.5F, 1}},
                  {{0, 2, 1}, {0, 1, 3}, {0, 1, 4}}, {0, 1, 2});
    EXPECT_EQ(make_polygons(scene).size(), 3U);
}

TEST(Surfaces, TheBackSideFacesTheOtherWay) {
    Scene scene;
    test::add_material(scene, vec3(0.5F));
    test::add_quad(scene, "Quad", vec3(0), vec3(2, 0, 0), vec3(0, 1, 0), 0);
    test::add_polygon(scene, "Triangle", {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, 0);
    const auto polygons = make_polygons(scene);
    ASSERT_EQ(polygons.size(), 2U);
    for (const Polygon& p : polygons) {
        const Surface front = make_surface(scene, p, false);
        const Surface back = make_surface(scene, p, true);
        EXPECT_GT(surface_area_vector(front).z, 0);
        EXPECT_EQ(surface_area_vector(front), -surface_area_vector(back));
        EXPECT_EQ(surface_center(front), surface_center(back));
        EXPECT_FALSE(front.back_side);
        EXPECT_TRUE(back.back_side);
        EXPECT_EQ(front.object, p.corner_count == 4 ? 0 : 1);
    }
}

TEST(Surfaces, LampsHaveTheirAreaAndFaceWhereTheyShine) {
    Lamp lamp;
    lamp.type = LampType::kArea;
    lamp.size = {2, 0.5F};
    lamp.to_world = glm::translate(mat4(1), vec3(1, 2, 3));
    const Surface rectangle = make_lamp_surface(lamp, 7);
    EXPECT_EQ(rectangle.lamp, 7);
    EXPECT_NEAR(surface_area_vector(rectangle).z, -1, 1e-5F);
    EXPECT_NEAR(glm::distance(surface_center(rectangle), vec3(1, 2, 3)), 0, 1e-6F);
    lamp.shape = AreaShape::kEllipse;
    EXPECT_NEAR(surface_area(make_lamp_surface(lamp, 7)), kPi / 4, 1e-5F);
}

}  // namespace
}  // namespace antiradiance
