// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/camera_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace antiradiance {
namespace {

Camera camera(CameraType type) {
    Camera c;
    c.type = type;
    c.to_world = glm::translate(mat4(1), vec3(1, 2, 3));  // looks along -z
    c.left = -1;
    c.right = 2;  // shifted
    c.bottom = -0.5F;
    c.top = 0.5F;
    c.clip_start = 0.5F;
    c.clip_end = 20;
    c.width = c.x1 = 300;
    c.height = c.y1 = 100;
    return c;
}

TEST(CameraRays, PerspectiveGoesThroughTheFrameAtDistanceOne) {
    const Camera c = camera(CameraType::kPerspective);
    const CameraRays rays(c);
    struct Case {
        vec2 pixel;
        vec3 through;  // from the eye
    };
    for (const auto& [pixel, through] :
         {Case{{0, 0}, {-1, -0.5F, -1}}, Case{{300, 100}, {2, 0.5F, -1}},
          Case{{100, 50}, {0, 0, -1}}}) {
        const CameraRay ray = rays.at(pixel);
        EXPECT_EQ(ray.origin, vec3(1, 2, 3));
        EXPECT_NEAR(glm::length(ray.direction), 1, 1e-6F);
        EXPECT_LT(glm::distance(ray.direction, glm::normalize(through)), 1e-6F);
        // The clipping planes are planes: nearer along the axis than along a slanted ray.
        EXPECT_NEAR(ray.near * ray.axial, 0.5F, 1e-6F);
        EXPECT_NEAR(ray.far * ray.axial, 20, 1e-4F);
        EXPECT_NEAR((ray.direction * ray.near).z, -0.5F, 1e-6F);
    }
}

TEST(CameraRays, OrthographicRaysAreParallel) {
    const Camera c = camera(CameraType::kOrthographic);
    const CameraRays rays(c);
    const CameraRay low = rays.at({0, 0});
    const CameraRay high = rays.at({300, 100});
    EXPECT_EQ(low.direction, vec3(0, 0, -1));
    EXPECT_EQ(high.direction, vec3(0, 0, -1));
    EXPECT_LT(glm::distance(low.origin, vec3(0, 1.5F, 3)), 1e-6F);
    EXPECT_LT(glm::distance(high.origin, vec3(3, 2.5F, 3)), 1e-6F);
    EXPECT_EQ(low.axial, 1);
    EXPECT_EQ(low.near, 0.5F);
    EXPECT_EQ(low.far, 20);
}

TEST(CameraRays, TurnWithTheCamera) {
    Camera c = camera(CameraType::kPerspective);
    c.to_world = glm::inverse(glm::lookAt(vec3(4, 0, 1), vec3(0, 0, 1), vec3(0, 0, 1)));
    const CameraRays rays(c);
    EXPECT_LT(glm::distance(rays.at({100, 50}).direction, vec3(-1, 0, 0)), 1e-6F);
    // Right of the picture: +y when looking along -x with z up.
    EXPECT_GT(rays.at({300, 50}).direction.y, 0.5F);
    EXPECT_GT(rays.at({100, 100}).direction.z, 0.1F);
}

}  // namespace
}  // namespace antiradiance
