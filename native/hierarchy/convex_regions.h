// SPDX-License-Identifier: GPL-3.0-or-later
// O' of the paper's algorithm 2: the largest surface that blocks light and that an occluder belongs
// to. A test against its outline is exact only where it is plane and convex.
#pragma once

#include <span>
#include <vector>

#include "hierarchy/patch_tree.h"
#include "scene/scene.h"

namespace antiradiance {

using RegionId = std::int32_t;  // index into ConvexRegions::regions

// A plane convex polygon that is opaque all over.
struct ConvexRegion {
    vec3 normal;               // unit
    float offset;              // m: normal . p on its plane
    std::uint32_t begin, end;  // into ConvexRegions::corners and edges
};

struct ConvexRegions {
    std::vector<ConvexRegion> regions;
    std::vector<vec3> corners;  // m, counter-clockwise about the normal
    // Of the edge from each corner to the next: unit normal in the plane that points inside, and
    // the offset d for which dot(normal, p) + d is p's distance from the edge.
    std::vector<vec4> edges;
    std::vector<RegionId> of_surface;  // #surfaces; kNone: blocks nothing (a lamp, a needle)
    float tolerance = 0;               // m: what rounding does to corners

    [[nodiscard]] float height(RegionId r, const vec3& p) const {
        const ConvexRegion& region = regions[static_cast<std::size_t>(r)];
        return glm::dot(region.normal, p) - region.offset;
    }
    [[nodiscard]] std::span<const vec4> edges_of(RegionId r) const {
        const ConvexRegion& region = regions[static_cast<std::size_t>(r)];
        return std::span(edges).subspan(region.begin, region.end - region.begin);
    }
    [[nodiscard]] std::span<const vec3> corners_of(RegionId r) const {
        const ConvexRegion& region = regions[static_cast<std::size_t>(r)];
        return std::span(corners).subspan(region.begin, region.end - region.begin);
    }
};

// Joins the scene's polygons (make_polygons), whichever side is lit and whichever object they
// belong to, across whole edges that they share, as long as the union stays in one plane (1 degree,
// and 1e-5 of the scene) and convex. Greedy: every polygon ends in one region, an L in two, and a
// wall with a door stays cut so that none covers the door. Edges of one direction first, so that a
// grid of any size becomes strips and then one rectangle. O(n log n).
// Materials have no transparency: every surface but a lamp's is opaque.
// extent: m, of the scene whose patches are tested against the regions.
ConvexRegions find_convex_regions(const Scene& scene, std::span<const Surface> surfaces,
                                  float extent);
inline ConvexRegions find_convex_regions(const Scene& scene, std::span<const Surface> surfaces) {
    return find_convex_regions(scene, surfaces, largest_extent(scene));
}

}  // namespace antiradiance
