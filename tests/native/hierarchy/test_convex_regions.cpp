// SPDX-License-Identifier: GPL-3.0-or-later
#include "hierarchy/convex_regions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "support/scene_builder.h"
#include "support/scenes.h"
#include "support/tree_builder.h"

namespace antiradiance {
namespace {

const vec3 kX(1, 0, 0);
const vec3 kY(0, 1, 0);
const vec3 kZ(0, 0, 1);

ConvexRegions regions_of(const Scene& scene) {
    return find_convex_regions(scene, test::front_surfaces(scene));
}

double area_of(const ConvexRegions& regions, RegionId r) {
    const auto corners = regions.corners_of(r);
    vec3 sum(0);
    for (std::size_t i = 2; i < corners.size(); ++i)
        sum += 0.5F * glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
    return glm::dot(sum, regions.regions[static_cast<std::size_t>(r)].normal);
}

bool covers(const ConvexRegions& regions, RegionId r, const vec3& p) {
    if (std::abs(regions.height(r, p)) > 1e-4F) return false;
    for (const vec4& edge : regions.edges_of(r)) {
        if (glm::dot(edge, vec4(p, 1)) < -1e-4F) return false;
    }
    return true;
}

// Regions of one plane never overlap, every surface lies in its own, and all are convex.
void expect_sound(const Scene& scene) {
    const std::vector<Surface> surfaces = test::front_surfaces(scene);
    const ConvexRegions regions = find_convex_regions(scene, surfaces);
    ASSERT_EQ(regions.of_surface.size(), surfaces.size());
    double covered = 0;
    for (std::size_t r = 0; r < regions.regions.size(); ++r) {
        const auto id = static_cast<RegionId>(r);
        for (const vec3& corner : regions.corners_of(id))
            EXPECT_TRUE(covers(regions, id, corner)) << "not convex: " << r;
        covered += area_of(regions, id);
    }
    double area = 0;
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        area += surface_area(surfaces[s]);
        const RegionId r = regions.of_surface[s];
        ASSERT_NE(r, kNone);
        for (int i = 0; i < surfaces[s].corner_count; ++i)
            EXPECT_TRUE(covers(regions, r, surfaces[s].corners[static_cast<std::size_t>(i)])) << s;
    }
    EXPECT_NEAR(covered, area, 1e-4 * area);
}

Scene grid(int columns, int rows, const mat4& to_world = mat4(1)) {
    Scene scene;
    const int m = test::add_material(scene, vec3(0.5F));
    for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < rows; ++j) {
            const vec3 low(static_cast<float>(i) * 0.3F, static_cast<float>(j) * 0.2F, 0);
            test::add_polygon(scene, "Tile",
                              {low, low + 0.3F * kX, low + 0.3F * kX + 0.2F * kY, low + 0.2F * kY},
                              m, {}, to_world);
        }
    }
    return scene;
}

TEST(ConvexRegions, AGridIsOneRectangle) {
    const mat4 tilted =
        glm::translate(mat4(1), vec3(3, -2, 1)) * glm::rotate(mat4(1), 0.7F, vec3(1, 2, 3));
    for (const mat4& to_world : {mat4(1), tilted}) {
        const Scene scene = grid(9, 7, to_world);
        const ConvexRegions regions = regions_of(scene);
        ASSERT_EQ(regions.regions.size(), 1U);
        EXPECT_EQ(regions.corners.size(), 4U);
        EXPECT_NEAR(area_of(regions, 0), 9 * 0.3 * 7 * 0.2, 1e-4);
        expect_sound(scene);
    }
}

TEST(ConvexRegions, SidesOfEitherWindingJoin) {
    Scene scene;
    const int m = test::add_material(scene, vec3(0.5F));
    test::add_quad(scene, "Up", vec3(0), kX, kY, m);
    test::add_quad(scene, "Down", kX, kY, kX, m);  // its front looks the other way
    const ConvexRegions regions = regions_of(scene);
    ASSERT_EQ(regions.regions.size(), 1U);
    EXPECT_NEAR(area_of(regions, 0), 2, 1e-5);
}

TEST(ConvexRegions, AnLIsTwo) {
    Scene scene;
    const int m = test::add_material(scene, vec3(0.5F));
    test::add_quad(scene, "Corner", vec3(0), kX, kY, m);
    test::add_quad(scene, "Right", kX, kX, kY, m);
    test::add_quad(scene, "Above", kY, kX, kY, m);
    const ConvexRegions regions = regions_of(scene);
    ASSERT_EQ(regions.regions.size(), 2U);
    EXPECT_NEAR(area_of(regions, 0) + area_of(regions, 1), 3, 1e-5);
    expect_sound(scene);
}

TEST(ConvexRegions, ATriangulatedConcavePolygonIsCut) {
    // A plus sign: 12 corners, 10 triangles, cut at best into 3 rectangles.
    Scene scene;
    const int m = test::add_material(scene, vec3(0.5F));
    for (const vec2 cell : {vec2(1, 0), vec2(0, 1), vec2(1, 1), vec2(2, 1), vec2(1, 2)}) {
        const vec3 low(cell, 0);
        test::add_polygon(scene, "Half", {low, low + kX, low + kX + kY}, m);
        test::add_polygon(scene, "Half", {low, low + kX + kY, low + kY}, m);
    }
    const ConvexRegions regions = regions_of(scene);
    EXPECT_EQ(regions.regions.size(), 3U);
    for (std::size_t r = 0; r < regions.regions.size(); ++r)
        EXPECT_FALSE(covers(regions, static_cast<RegionId>(r), vec3(0.5F, 0.5F, 0)));
    expect_sound(scene);
}

TEST(ConvexRegions, NoneCoversADoor) {
    // A wall of 5 x 3 with a door of 1 x 2, triangulated as Blender would an n-gon.
    const std::vector<vec3> corners{{0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {3, 0, 2},
                                    {3, 0, 0}, {5, 0, 0}, {5, 0, 3}, {0, 0, 3}};
    Scene scene;
    const int m = test::add_material(scene, vec3(0.5F));
    for (const auto& [a, b, c] : std::vector<std::array<std::size_t, 3>>{
             {0, 1, 2}, {0, 2, 7}, {7, 2, 3}, {7, 3, 6}, {6, 3, 4}, {6, 4, 5}})
        test::add_polygon(scene, "Wall", {corners[a], corners[b], corners[c]}, m);
    const ConvexRegions regions = regions_of(scene);
    EXPECT_LE(regions.regions.size(), 4U);
    for (std::size_t r = 0; r < regions.regions.size(); ++r) {
        for (const vec3 in_door : {vec3(2.05F, 0, 0.1F), vec3(2.5F, 0, 1), vec3(2.95F, 0, 1.95F)})
            EXPECT_FALSE(covers(regions, static_cast<RegionId>(r), in_door));
    }
    expect_sound(scene);
}

TEST(ConvexRegions, WhatDoesNotTouchOrLiesInAnotherPlaneStaysApart) {
    Scene scene;
    const int m = test::add_material(scene, vec3(0.5F));
    test::add_quad(scene, "One", vec3(0), kX, kY, m);
    test::add_quad(scene, "Beyond a gap", 1.001F * kX, kX, kY, m);
    test::add_quad(scene, "Bent by 2 degrees", kY, kX, kY + 0.035F * kZ, m);
    EXPECT_EQ(regions_of(scene).regions.size(), 3U);
}

TEST(ConvexRegions, ACylinderStaysRound) {
    // 720 facets of half a degree: each is coplanar with the next, all together are not.
    Scene scene;
    const int m = test::add_material(scene, vec3(0.5F));
    const auto at = [](int i) {
        const float angle = 2 * kPi * static_cast<float>(i) / 720;
        return vec3(std::cos(angle), std::sin(angle), 0);
    };
    for (int i = 0; i < 720; ++i)
        test::add_quad(scene, "Facet", at(i), at(i + 1) - at(i), kZ, m);
    const ConvexRegions regions = regions_of(scene);
    for (std::size_t r = 0; r < regions.regions.size(); ++r) {
        for (const vec3& corner : regions.corners_of(static_cast<RegionId>(r)))
            EXPECT_LE(std::abs(regions.height(static_cast<RegionId>(r), corner)), 1e-4F);
    }
}

TEST(ConvexRegions, AFoldedQuadIsNoPlane) {
    Scene scene;
    const int m = test::add_material(scene, vec3(0.5F));
    // Folded by less than a degree: one polygon of the hierarchy, but a plane to .004 only.
    test::add_polygon(scene, "Sheet", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.008F}, {0, 1, 0}}, m);
    ASSERT_EQ(test::front_surfaces(scene).size(), 1U);
    const ConvexRegions regions = regions_of(scene);
    EXPECT_EQ(regions.regions.size(), 2U);
    EXPECT_NE(regions.of_surface[0], kNone);
}

TEST(ConvexRegions, LampsBlockNothing) {
    Scene scene = grid(1, 1);
    std::vector<Surface> surfaces = test::front_surfaces(scene);
    Lamp lamp;
    lamp.type = LampType::kArea;
    surfaces.push_back(make_lamp_surface(lamp, 0));
    const ConvexRegions regions = find_convex_regions(scene, surfaces);
    EXPECT_NE(regions.of_surface[0], kNone);
    EXPECT_EQ(regions.of_surface[1], kNone);
}

TEST(ConvexRegions, RoomsAreSound) {
    expect_sound(test::office());
    expect_sound(test::corridor());
    expect_sound(test::floating_boxes(3));
}

}  // namespace
}  // namespace antiradiance
