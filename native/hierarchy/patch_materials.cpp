// SPDX-License-Identifier: GPL-3.0-or-later
#include "hierarchy/patch_materials.h"

#include <algorithm>

#include "hierarchy/push_pull.h"
#include "scene/lamp.h"

namespace antiradiance {

namespace {

constexpr int kTextureSamples = 8;  // per side of a textured leaf patch

// Barycentric weights (of corners 1 and 2) of the point nearest to p in a triangle's plane.
vec2 barycentric(const std::array<vec3, 3>& c, const vec3& p) {
    const vec3 e1 = c[1] - c[0];
    const vec3 e2 = c[2] - c[0];
    const vec3 d = p - c[0];
    const float d11 = glm::dot(e1, e1);
    const float d12 = glm::dot(e1, e2);
    const float d22 = glm::dot(e2, e2);
    const float determinant = d11 * d22 - d12 * d12;
    if (determinant <= 0) return {1.0F / 3, 1.0F / 3};
    const float d1 = glm::dot(d, e1);
    const float d2 = glm::dot(d, e2);
    return {(d22 * d1 - d12 * d2) / determinant, (d11 * d2 - d12 * d1) / determinant};
}

struct SurfacePoint {
    TriangleId triangle;
    vec2 barycentric;
};

// The original triangle below a point of a surface.
SurfacePoint triangle_at(const Scene& scene, const Surface& s, const vec3& p) {
    const auto inside = [](const vec2& b) { return std::min({b.x, b.y, 1 - b.x - b.y}); };
    const vec2 b0 = barycentric(scene.corners(s.triangles[0]), p);
    if (s.triangles[1] == kNone) return {s.triangles[0], b0};
    const vec2 b1 = barycentric(scene.corners(s.triangles[1]), p);
    return inside(b0) >= inside(b1) ? SurfacePoint{s.triangles[0], b0}
                                    : SurfacePoint{s.triangles[1], b1};
}

void set_material(const Scene& scene, const PatchTree& tree, NodeId leaf,
                  PatchMaterials& materials) {
    const auto n = static_cast<std::size_t>(leaf);
    const Surface& s = tree.surfaces[static_cast<std::size_t>(tree.surface[n])];
    if (s.lamp != kNone) {
        materials.emission[n] = area_lamp_radiance(scene.lamps[static_cast<std::size_t>(s.lamp)]);
        return;
    }
    const Material& material = scene.materials[static_cast<std::size_t>(s.material)];
    materials.albedo[n] = material.albedo;
    materials.emission[n] = material.emission;
    if (material.albedo_texture == kNone && material.emission_texture == kNone) return;
    vec3 albedo(0);
    vec3 emission(0);
    for (int j = 0; j < kTextureSamples; ++j) {
        for (int i = 0; i < kTextureSamples; ++i) {
            const vec2 sample = (vec2(i, j) + 0.5F) / static_cast<float>(kTextureSamples);
            const SurfacePoint p = triangle_at(scene, s, tree.patch_point(leaf, sample));
            albedo += scene.albedo_at(p.triangle, p.barycentric);
            emission += scene.emission_at(p.triangle, p.barycentric);
        }
    }
    materials.albedo[n] = albedo / static_cast<float>(kTextureSamples * kTextureSamples);
    materials.emission[n] = emission / static_cast<float>(kTextureSamples * kTextureSamples);
}

}  // namespace

PatchMaterials average_materials(const Scene& scene, const PatchTree& tree) {
    PatchMaterials materials;
    materials.albedo.assign(tree.size(), vec3(0));
    materials.emission.assign(tree.size(), vec3(0));
    for (const NodeId leaf : tree.leaves)
        set_material(scene, tree, leaf, materials);
    pull_area_average<vec3>(tree, materials.albedo);
    pull_area_average<vec3>(tree, materials.emission);
    return materials;
}

}  // namespace antiradiance
