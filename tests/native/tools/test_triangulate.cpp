// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/triangulate.h"

#include <gtest/gtest.h>

#include <limits>

namespace antiradiance {
namespace {

vec3 area_vector(const std::vector<vec3>& corners, const uvec3& t) {
    return 0.5F * glm::cross(corners[t[1]] - corners[t[0]], corners[t[2]] - corners[t[0]]);
}

// Triangles of one winding whose areas add up to the polygon's cover it exactly once.
void expect_exact_cover(const std::vector<vec3>& corners, const vec3& normal, float area) {
    const std::vector<uvec3> triangles = triangulate(corners);
    ASSERT_EQ(triangles.size(), corners.size() - 2);
    float sum = 0;
    for (const uvec3& t : triangles) {
        const float part = glm::dot(area_vector(corners, t), normal);
        EXPECT_GE(part, 0);
        sum += part;
    }
    EXPECT_NEAR(sum, area, 1e-5F * area);
}

TEST(triangulate, a_convex_polygon_is_a_fan_around_its_first_corner) {
    const std::vector<vec3> pentagon{{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 2, 0}, {-1, 1, 0}};
    const std::vector<uvec3> triangles = triangulate(pentagon);
    ASSERT_EQ(triangles.size(), 3U);
    EXPECT_EQ(triangles[0], uvec3(0, 1, 2));
    EXPECT_EQ(triangles[1], uvec3(0, 2, 3));
    EXPECT_EQ(triangles[2], uvec3(0, 3, 4));
}

TEST(triangulate, covers_a_concave_quad_wherever_its_notch_is) {
    const std::vector<vec3> arrow{{0, 0, 0}, {2, 0, 0}, {0.5F, 0.5F, 0}, {0, 2, 0}};
    for (std::size_t turn = 0; turn < 4; ++turn) {
        std::vector<vec3> turned;
        for (std::size_t i = 0; i < 4; ++i)
            turned.push_back(arrow[(i + turn) % 4]);
        expect_exact_cover(turned, vec3(0, 0, 1), 1);
    }
}

TEST(triangulate, covers_a_letter_u_in_every_orientation) {
    const std::vector<vec3> flat{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0},
                                 {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {1.0F, -1.0F}) {
            std::vector<vec3> corners;
            for (const vec3& c : flat) {
                vec3 p(7);
                p[(axis + 1) % 3] = c.x * side;  // a mirror turns the normal round
                p[(axis + 2) % 3] = c.y;
                corners.push_back(p);
            }
            vec3 normal(0);
            normal[axis] = side;
            expect_exact_cover(corners, normal, 7);
        }
    }
}

TEST(triangulate, covers_a_square_with_a_hole_on_a_slit) {
    const std::vector<vec3> corners{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0},
                                    {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}};
    expect_exact_cover(corners, vec3(0, 0, 1), 8);
}

TEST(triangulate, survives_what_is_no_polygon) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(triangulate(std::vector<vec3>{{0, 0, 0}, {1, 0, 0}}).empty());
    EXPECT_EQ(triangulate(std::vector<vec3>(6, vec3(1))).size(), 4U);
    EXPECT_EQ(triangulate(std::vector<vec3>(5, vec3(nan))).size(), 3U);
    const std::vector<vec3> bow_tie{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(triangulate(bow_tie).size(), 2U);
}

}  // namespace
}  // namespace antiradiance
