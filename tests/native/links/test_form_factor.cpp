// SPDX-License-Identifier: GPL-3.0-or-later
// Form factors against closed forms (Howell, "A Catalog of Radiation Heat Transfer Configuration
// Factors", C-11, C-14, C-41).
#include "links/form_factor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>

#include "links/pair_geometry.h"

namespace antiradiance {
namespace {

const vec3 kUp(0, 0, 1);

struct Known {
    float distance;
    double form_factor;
};
constexpr Known kParallelSquares[] = {{0.1F, .826994522}, {0.25F, .632036430}, {0.5F, .415253284},
                                      {1, .199824896},    {2, .068589589},     {4, .019106958},
                                      {10, .003162057}};
constexpr Known kPerpendicular[] = {  // distance: height of the wall on the square's edge
    {0.1F, .043251369},
    {0.5F, .146186679},
    {1, .200043776},
    {2, .232852603},
    {10, .249209486}};
constexpr Known kCoaxialDisks[] = {{0.5F, .609611797}, {1, .381966011}, {2, .171572875}};

// Unit square above or around the origin whose front looks down.
std::array<vec3, 4> ceiling(float height, float low = 0) {
    return {vec3(low, low, height), vec3(low, low + 1, height), vec3(low + 1, low + 1, height),
            vec3(low + 1, low, height)};
}

// Mean over the unit square; points crowd towards x = 0, where a wall may stand.
double mean_over_square(const std::function<double(const vec3&)>& f) {
    constexpr int kPoints = 160;
    double sum = 0;
    for (int j = 0; j < kPoints; ++j) {
        for (int i = 0; i < kPoints; ++i) {
            const double u = (i + 0.5) / kPoints;
            const double y = (j + 0.5) / kPoints;
            sum += 2 * u * f({static_cast<float>(u * u), static_cast<float>(y), 0});
        }
    }
    return sum / (kPoints * kPoints);
}

// The integrand is bounded and smooth inside; 160 x 160 midpoints leave about 1e-4.
constexpr double kQuadrature = 2e-4;

TEST(PointFormFactor, ParallelSquares) {
    for (const Known& known : kParallelSquares) {
        const auto source = ceiling(known.distance);
        const double f =
            mean_over_square([&](const vec3& p) { return point_form_factor(p, kUp, source); });
        EXPECT_NEAR(f / known.form_factor, 1, kQuadrature) << known.distance;
    }
}

TEST(PointFormFactor, PerpendicularSquares) {
    for (const Known& known : kPerpendicular) {
        const float h = known.distance;
        const std::array<vec3, 4> wall{vec3(0, 0, 0), vec3(0, 1, 0), vec3(0, 1, h), vec3(0, 0, h)};
        const double f =
            mean_over_square([&](const vec3& p) { return point_form_factor(p, kUp, wall); });
        EXPECT_NEAR(f / known.form_factor, 1, kQuadrature) << h;
    }
}

TEST(PointFormFactor, CoaxialDisks) {
    constexpr int kCorners = 512;  // of the polygon in place of the disk: 2.5e-5 of its area
    constexpr int kRadii = 200;
    for (const Known& known : kCoaxialDisks) {
        const vec3 center(0, 0, known.distance);
        const auto rim = [&](int i) {
            const double angle = 2 * std::numbers::pi * i / kCorners;
            return vec3(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)),
                        known.distance);
        };
        double mean = 0;
        for (int k = 0; k < kRadii; ++k) {  // rings of equal area
            const vec3 p(static_cast<float>(std::sqrt((k + 0.5) / kRadii)), 0, 0);
            for (int i = 0; i < kCorners; ++i) {
                const std::array<vec3, 3> slice{center, rim(i + 1), rim(i)};
                mean += point_form_factor(p, kUp, slice) / kRadii;
            }
        }
        EXPECT_NEAR(mean / known.form_factor, 1, kQuadrature) << known.distance;
    }
}

TEST(PointFormFactor, OfASquareAboveItsCorner) {
    // Howell B-4: a rectangle parallel to the point, with a corner above it.
    for (const float h : {0.1F, 1.0F, 10.0F}) {
        const double x = 1 / static_cast<double>(h);
        const double r = std::sqrt(1 + x * x);
        const double expected = x / r * std::atan(x / r) / std::numbers::pi;
        EXPECT_NEAR(point_form_factor(vec3(0), kUp, ceiling(h)) / expected, 1, 1e-5) << h;
    }
}

TEST(PointFormFactor, IsSignedByTheSideThatFacesThePoint) {
    const auto down = ceiling(1, -0.5F);
    std::array<vec3, 4> up = down;
    std::swap(up[1], up[3]);
    const float f = point_form_factor(vec3(0), kUp, down);
    EXPECT_GT(f, 0.2F);
    EXPECT_FLOAT_EQ(point_form_factor(vec3(0), kUp, up), -f);
}

TEST(PointFormFactor, EndsAtTheHorizon) {
    EXPECT_EQ(point_form_factor(vec3(0), -kUp, ceiling(1)), 0);
    // A wall from z = -1 to 1 counts by its upper half alone.
    const std::array<vec3, 4> wall{vec3(2, -1, -1), vec3(2, -1, 1), vec3(2, 1, 1), vec3(2, 1, -1)};
    const std::array<vec3, 4> upper{vec3(2, -1, 0), vec3(2, -1, 1), vec3(2, 1, 1), vec3(2, 1, 0)};
    const float f = point_form_factor(vec3(0), kUp, wall);
    EXPECT_GT(f, 0.01F);
    EXPECT_NEAR(f, point_form_factor(vec3(0), kUp, upper), 1e-7F);
    // Clipping a corner off makes five.
    const std::array<vec3, 4> dipped{vec3(2, -1, -0.1F), vec3(2, -1, 1), vec3(2, 1, 1),
                                     vec3(2, 1, 0.5F)};
    const std::array<vec3, 3> first{dipped[0], dipped[1], dipped[2]};
    const std::array<vec3, 3> second{dipped[0], dipped[2], dipped[3]};
    EXPECT_NEAR(point_form_factor(vec3(0), kUp, dipped),
                point_form_factor(vec3(0), kUp, first) + point_form_factor(vec3(0), kUp, second),
                1e-7F);
}

TEST(FarFormFactor, ApproachesThePolygon) {
    for (const float d : {8.0F, 32.0F, 128.0F}) {
        const vec3 p(d, 0.3F * d, 0);
        const std::array<vec3, 4> s{vec3(0, 0, d), vec3(0, 1, d), vec3(1, 1, d), vec3(1, 0, d)};
        const float exact = point_form_factor(p, kUp, s);
        const float far = far_form_factor(p, kUp, vec3(0.5F, 0.5F, d), -kUp, 1);
        EXPECT_NEAR(far / exact, 1, 0.5F / (d * d)) << d;  // the error falls with the square
        EXPECT_FLOAT_EQ(far_form_factor(p, kUp, vec3(0.5F, 0.5F, d), kUp, 1), -far);
        EXPECT_EQ(far_form_factor(p, -kUp, vec3(0.5F, 0.5F, d), -kUp, 1), 0);
    }
}

const std::array<vec3, 4> kFloor{vec3(0, 0, 0), vec3(1, 0, 0), vec3(1, 1, 0), vec3(0, 1, 0)};

Surface surface_of(std::span<const vec3> corners) {
    Surface s;
    std::copy(corners.begin(), corners.end(), s.corners.begin());
    s.corner_count = static_cast<std::int32_t>(corners.size());
    return s;
}

// ff(source -> receiver) as the links compute it.
float between(std::span<const vec3> source, std::span<const vec3> receiver, bool behind = false) {
    const GrowingTree tree({surface_of(source), surface_of(receiver)});
    NodeId nodes[2] = {kNone, kNone};
    for (NodeId n = 0; n < static_cast<NodeId>(tree.size()); ++n) {
        if (!tree.node(n).is_cluster()) nodes[tree.node(n).surface] = n;
    }
    return patch_form_factor(tree.node(nodes[0]), tree.node(nodes[1]), behind);
}

TEST(PatchFormFactor, ParallelSquares) {
    for (const Known& known : kParallelSquares) {
        // From a distance of 1.6 radii on below 1 % off, as promised; .3 % as measured. Nearer, 4 x
        // 4 points still do, until the distance falls below that of the points.
        const double floor = known.distance < 0.2F ? 0.05 : 0.003;
        const float f = between(ceiling(known.distance), kFloor);
        EXPECT_NEAR(f / known.form_factor, 1, floor) << known.distance;
    }
}

TEST(PatchFormFactor, PerpendicularSquares) {
    for (const Known& known : kPerpendicular) {
        const float h = known.distance;
        if (h < 0.5F) continue;  // the hierarchy cuts such strips
        const std::array<vec3, 4> wall{vec3(0, 0, 0), vec3(0, 1, 0), vec3(0, 1, h), vec3(0, 0, h)};
        EXPECT_NEAR(between(wall, kFloor) / known.form_factor, 1, 0.003) << h;
    }
}

TEST(PatchFormFactor, TrianglesAreHalvesOfASquare) {
    // Second-order means of triangles against those of the square that they make up.
    for (const float d : {1.0F, 3.0F, 5.0F, 20.0F}) {
        const vec3 away(0.7F * d, 0.2F * d, 0);
        std::array<vec3, 4> source = ceiling(d);
        for (vec3& c : source)
            c += away;
        const float square = between(source, kFloor);
        const std::array<vec3, 3> low{kFloor[0], kFloor[1], kFloor[2]};
        const std::array<vec3, 3> high{kFloor[0], kFloor[2], kFloor[3]};
        EXPECT_NEAR((between(source, low) + between(source, high)) / 2 / square, 1, 0.01) << d;
        // As sources they add up.
        const std::array<vec3, 3> first{source[0], source[1], source[2]};
        const std::array<vec3, 3> second{source[0], source[2], source[3]};
        EXPECT_NEAR((between(first, kFloor) + between(second, kFloor)) / square, 1, 0.01) << d;
    }
}

TEST(PatchFormFactor, ReceiversBehindCountForAntiradianceAlone) {
    std::array<vec3, 4> up = ceiling(1);
    std::swap(up[1], up[3]);
    EXPECT_EQ(between(up, kFloor), 0);
    EXPECT_FLOAT_EQ(between(up, kFloor, true), between(ceiling(1), kFloor));
    EXPECT_EQ(between(ceiling(1), kFloor, true), 0);
    // A source whose plane cuts the floor in two serves each half once: parts of a whole.
    const std::array<vec3, 4> divider{vec3(0.5F, 0, 0.2F), vec3(0.5F, 1, 0.2F), vec3(0.5F, 1, 1.2F),
                                      vec3(0.5F, 0, 1.2F)};
    const float front = between(divider, kFloor);
    const float back = between(divider, kFloor, true);
    EXPECT_GT(front, 0.02F);
    EXPECT_NEAR(front, back, 1e-6F);
}

}  // namespace
}  // namespace antiradiance
