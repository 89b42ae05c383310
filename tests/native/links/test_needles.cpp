// SPDX-License-Identifier: GPL-3.0-or-later
// Long thin polygons, of which real models are full: frames, skirting, the edges of boards.
#include <gtest/gtest.h>

#include <cmath>

#include "hierarchy/growing_tree.h"
#include "links/form_factor.h"
#include "links/refine.h"

namespace antiradiance {
namespace {

// Rounding puts the corners of a needle in the receiver's plane above and below it in turn, so that
// all four edges cross the horizon.
TEST(Needles, FormFactorOfCornersThatAlternateAboutTheHorizon) {
    const float h = 1e-7F;
    const std::array<vec3, 4> needle{vec3(1, 0, h), vec3(4, 0, -h), vec3(4, 0.002F, h),
                                     vec3(1, 0.002F, -h)};
    const float ff = point_form_factor({0, 0, 0}, {0, 0, 1}, needle);
    EXPECT_LT(std::abs(ff), 1e-5F);
}

Surface needle(float x, float width, float length) {
    Surface s;
    s.corners = {vec3(x, 0, 0), vec3(x + width, 0, 0), vec3(x + width, length, 0),
                 vec3(x, length, 0)};
    s.corner_count = 4;
    return s;
}

Surface facing_down(float height, float width, float length) {
    Surface s;
    s.corners = {vec3(0, 0, height), vec3(0, length, height), vec3(width, length, height),
                 vec3(width, 0, height)};
    s.corner_count = 4;
    return s;
}

std::size_t links_of(int needles) {
    constexpr float kLength = 5;
    constexpr float kEdge = 0.5F;
    std::vector<Surface> surfaces;
    for (int i = 0; i < needles; ++i) {
        const float x = 2.0F * static_cast<float>(i) / static_cast<float>(needles);
        surfaces.push_back(needle(x, 0.002F, kLength));
        Surface back = surfaces.back();
        std::swap(back.corners[1], back.corners[3]);
        for (vec3& corner : back.corners)
            corner.z += 0.1F;
        surfaces.push_back(back);  // faces the needles, 10 cm above them
    }
    surfaces.push_back(facing_down(2, 2, kLength));
    GrowingTree tree(std::move(surfaces));
    tree.split_to(kEdge);
    RefineOptions options;
    options.antiradiance = false;
    options.cluster_links = true;
    options.least_edge = kEdge / 2;
    Progress progress;
    return refine_links(tree, DirectionBins(128), options, progress).links.size();
}

// A pair of needles, cut into pieces of the least size, would make 20 x 20 links and more each way.
// What they exchange is nothing beside what the ceiling sends.
TEST(Needles, MakeFewLinksWithEachOther) {
    constexpr int kNeedles = 50;
    const std::size_t links = links_of(kNeedles);
    EXPECT_GT(links, 2U * kNeedles * kNeedles);
    EXPECT_LT(links, 100U * kNeedles * kNeedles);  // measured: 79 a pair
}

}  // namespace
}  // namespace antiradiance
