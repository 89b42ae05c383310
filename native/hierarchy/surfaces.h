// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "hierarchy/patch_tree.h"
#include "scene/scene.h"

namespace antiradiance {

// A polygon of the input before its lit sides are known: a triangle, or two that share an edge.
struct Polygon {
    std::array<vec3, 4> corners;  // counter-clockwise seen from the front
    std::array<TriangleId, 2> triangles{kNone, kNone};
    std::int32_t corner_count = 3;
    [[nodiscard]] vec3 area_vector() const;  // front normal times area
};

// Every triangle of the scene, once. Two triangles of one object and material that share an edge,
// lie in one plane (within 1 degree) and form a convex quad become one polygon: first those cut
// from the same mesh polygon, then any, longest shared edge first, so that a triangulated quad mesh
// is a quad mesh again.
std::vector<Polygon> make_polygons(const Scene& scene);

// The side of a polygon as a surface of the hierarchy.
Surface make_surface(const Scene& scene, const Polygon& polygon, bool back_side);

vec3 surface_center(const Surface& surface);       // m
vec3 surface_area_vector(const Surface& surface);  // m2, normal times area
inline float surface_area(const Surface& surface) {
    return glm::length(surface_area_vector(surface));
}

// The four corners of a rectangular or elliptic area lamp (ellipse: the rectangle of equal area).
Surface make_lamp_surface(const Lamp& lamp, std::int32_t lamp_index);

}  // namespace antiradiance
