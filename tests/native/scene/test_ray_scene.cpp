// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/ray_scene.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "support/scene_builder.h"

namespace antiradiance {
namespace {

// Unit square at z = 0, front up.
Scene one_quad() {
    Scene scene;
    test::add_quad(scene, "quad", vec3(0), vec3(1, 0, 0), vec3(0, 1, 0), kNone);
    return scene;
}

TEST(RayScene, tells_front_from_back) {
    const RayScene rays(one_quad());
    const RayHit above = rays.intersect(vec3(0.75F, 0.25F, 2), vec3(0, 0, -1));
    ASSERT_TRUE(above.hit());
    EXPECT_FALSE(above.back_side);
    EXPECT_FLOAT_EQ(above.distance, 2);
    const RayHit below = rays.intersect(vec3(0.75F, 0.25F, -3), vec3(0, 0, 1));
    ASSERT_TRUE(below.hit());
    EXPECT_TRUE(below.back_side);
    EXPECT_FLOAT_EQ(below.distance, 3);
}

TEST(RayScene, barycentric_weights_belong_to_corners_1_and_2) {
    const Scene scene = one_quad();
    const RayScene rays(scene);
    const vec3 target(0.8F, 0.3F, 0);
    const RayHit hit = rays.intersect(target + vec3(0, 0, 1), vec3(0, 0, -1));
    ASSERT_TRUE(hit.hit());
    const auto c = scene.corners(hit.triangle);
    const vec3 p = c[0] * (1 - hit.barycentric.x - hit.barycentric.y) + c[1] * hit.barycentric.x +
                   c[2] * hit.barycentric.y;
    EXPECT_NEAR(glm::distance(p, target), 0, 1e-6F);
}

TEST(RayScene, respects_near_and_far) {
    const RayScene rays(one_quad());
    const vec3 origin(0.5F, 0.25F, 2);
    EXPECT_FALSE(rays.intersect(origin, vec3(0, 0, -1), 0, 1.9F).hit());
    EXPECT_FALSE(rays.intersect(origin, vec3(0, 0, -1), 2.1F).hit());
    EXPECT_TRUE(rays.intersect(origin, vec3(0, 0, -1), 1.9F, 2.1F).hit());
}

TEST(RayScene, occlusion_is_of_the_open_segment) {
    const RayScene rays(one_quad());
    EXPECT_TRUE(rays.occluded(vec3(0.5F, 0.4F, 1), vec3(0.5F, 0.4F, -1)));
    EXPECT_FALSE(rays.occluded(vec3(0.5F, 0.4F, 1), vec3(0.5F, 0.4F, 0.1F)));
    EXPECT_FALSE(rays.occluded(vec3(0.5F, 0.4F, 1), vec3(0.5F, 0.4F, 0)));  // ends on it
    EXPECT_FALSE(rays.occluded(vec3(2, 2, 1), vec3(2, 2, -1)));
    EXPECT_FALSE(rays.occluded(vec3(0.5F, 0.4F, 1), vec3(0.5F, 0.4F, 1)));
}

TEST(RayScene, escapes) {
    const RayScene rays(one_quad());
    EXPECT_FALSE(rays.escapes(vec3(0.5F, 0.4F, 1), vec3(0, 0, -1)));
    EXPECT_TRUE(rays.escapes(vec3(0.5F, 0.4F, 1), vec3(0, 0, 1)));
}

TEST(RayScene, a_closed_box_is_tight) {
    // Every ray from inside a closed box of 12 triangles hits, also along edges and diagonals.
    Scene scene;
    const vec3 x(1, 0, 0);
    const vec3 y(0, 1, 0);
    const vec3 z(0, 0, 1);
    test::add_quad(scene, "floor", vec3(0), x, y, kNone);
    test::add_quad(scene, "ceiling", z, x, y, kNone);
    test::add_quad(scene, "left", vec3(0), y, z, kNone);
    test::add_quad(scene, "right", x, y, z, kNone);
    test::add_quad(scene, "front", vec3(0), x, z, kNone);
    test::add_quad(scene, "back", y, x, z, kNone);
    const RayScene rays(scene);
    int escaped = 0;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        const vec2 u = r2_sample(i, 1);
        const vec3 edge_point = vec3(0, 0, 0) + u.x * z;  // of the edge x = y = 0
        const vec3 origin(0.5F, 0.5F, u.y);
        escaped += rays.escapes(origin, glm::normalize(edge_point - origin)) ? 1 : 0;
    }
    EXPECT_EQ(escaped, 0);
}

TEST(RayScene, an_empty_scene_blocks_nothing) {
    const RayScene rays{Scene{}};
    EXPECT_TRUE(rays.escapes(vec3(0), vec3(0, 0, 1)));
    EXPECT_FALSE(rays.intersect(vec3(0), vec3(0, 0, 1)).hit());
}

}  // namespace
}  // namespace antiradiance
