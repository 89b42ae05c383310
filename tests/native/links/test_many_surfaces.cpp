// SPDX-License-Identifier: GPL-3.0-or-later
// Models of many small triangles: what clusters save, and what it costs to do without them.
#include <gtest/gtest.h>

#include <cmath>

#include "hierarchy/growing_tree.h"
#include "links/estimate_links.h"
#include "links/refine.h"

namespace antiradiance {
namespace {

constexpr float kRoom = 8;  // m, edge of the room's floor and ceiling
constexpr float kEdge = 0.4F;

void add_quad(std::vector<Surface>& surfaces, const std::array<vec3, 4>& corners) {
    Surface s;
    s.corners = corners;
    s.corner_count = 4;
    surfaces.push_back(s);
}

// Triangles of a sphere, seen from outside.
void add_sphere(std::vector<Surface>& surfaces, const vec3& center, float radius, int rings) {
    const auto at = [&](int ring, int segment) {
        const float v = kPi * static_cast<float>(ring) / static_cast<float>(rings);
        const float u = kPi * static_cast<float>(segment) / static_cast<float>(rings);
        return center +
               radius * vec3(std::sin(v) * std::cos(u), std::sin(v) * std::sin(u), std::cos(v));
    };
    const auto triangle = [&](const vec3& a, const vec3& b, const vec3& c) {
        Surface s;
        s.corners = {a, b, c, c};
        surfaces.push_back(s);
    };
    for (int ring = 0; ring < rings; ++ring) {
        for (int segment = 0; segment < 2 * rings; ++segment) {
            const vec3 a = at(ring, segment);
            const vec3 b = at(ring + 1, segment);
            const vec3 c = at(ring + 1, segment + 1);
            const vec3 d = at(ring, segment + 1);
            if (ring + 1 < rings) triangle(a, b, c);
            if (ring > 0) triangle(a, c, d);
        }
    }
}

// Floor, ceiling and 25 spheres between them.
std::vector<Surface> spheres_in_a_room(int rings) {
    std::vector<Surface> surfaces;
    add_quad(surfaces,
             {vec3(0, 0, 0), vec3(kRoom, 0, 0), vec3(kRoom, kRoom, 0), vec3(0, kRoom, 0)});
    add_quad(surfaces,
             {vec3(0, 0, 3), vec3(0, kRoom, 3), vec3(kRoom, kRoom, 3), vec3(kRoom, 0, 3)});
    for (int i = 0; i < 25; ++i) {
        const auto x = static_cast<float>(i % 5) * 1.5F + 1;
        const auto y = static_cast<float>(i / 5) * 1.5F + 1;
        add_sphere(surfaces, {x, y, 0.6F + 0.07F * static_cast<float>(i % 7)}, 0.4F, rings);
    }
    return surfaces;
}

RefineOptions explicit_options() {
    RefineOptions options;
    options.antiradiance = false;
    options.cluster_links = true;
    options.least_edge = kEdge / 2;
    return options;
}

std::size_t explicit_links(std::vector<Surface> surfaces) {
    GrowingTree tree(std::move(surfaces));
    tree.split_to(kEdge);
    Progress progress;
    return refine_links(tree, DirectionBins(128), explicit_options(), progress).links.size();
}

TEST(ManySurfaces, ClustersKeepTheLinksOf50000TrianglesFew) {
    const std::vector<Surface> coarse = spheres_in_a_room(11);
    const std::vector<Surface> fine = spheres_in_a_room(23);
    ASSERT_GT(fine.size(), 50'000U);
    const auto coarse_links = static_cast<double>(explicit_links(coarse));
    const auto fine_links = static_cast<double>(explicit_links(fine));
    const auto growth = static_cast<double>(fine.size()) / static_cast<double>(coarse.size());
    EXPECT_LT(fine_links / coarse_links, 0.5 * growth);            // measured: 1.45 of 4.6
    EXPECT_LT(fine_links / static_cast<double>(fine.size()), 30);  // measured: 19
}

TEST(ManySurfaces, EstimateOfLinksWithoutClusters) {
    std::vector<Surface> surfaces = spheres_in_a_room(4);
    GrowingTree tree(std::move(surfaces));
    const double estimate = estimate_links_without_clusters(tree);
    RefineOptions options;
    options.receiver_levels = 0;
    options.least_edge = 2 * kRoom;  // as they are
    Progress progress;
    const auto links =
        static_cast<double>(refine_links(tree, DirectionBins(128), options, progress).links.size());
    EXPECT_GT(links, 0.5 * estimate);
    EXPECT_LT(links, 3 * estimate);  // touching pairs take several bins
}

}  // namespace
}  // namespace antiradiance
