// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/lit_triangles.h"

#include "hierarchy/lit_sides.h"
#include "hierarchy/surfaces.h"
#include "scene/ray_scene.h"

namespace antiradiance {

std::vector<std::array<std::uint8_t, 2>> find_lit_triangles(const Scene& scene,
                                                            Progress& progress) {
    const std::vector<Polygon> polygons = make_polygons(scene);
    const auto lit = find_lit_sides(scene, RayScene(scene), polygons, progress);
    std::vector<std::array<std::uint8_t, 2>> sides(scene.triangles.size());
    for (std::size_t p = 0; p < polygons.size(); ++p) {
        for (const TriangleId t : polygons[p].triangles) {
            if (t != kNone)
                sides[static_cast<std::size_t>(t)] = {static_cast<std::uint8_t>(lit[p][0]),
                                                      static_cast<std::uint8_t>(lit[p][1])};
        }
    }
    return sides;
}

}  // namespace antiradiance
