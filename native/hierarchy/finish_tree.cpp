// SPDX-License-Identifier: GPL-3.0-or-later
// GrowingTree -> PatchTree: preorder numbers and area averages of the materials.
#include <algorithm>

#include "hierarchy/growing_tree.h"
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

void set_material(const Scene& scene, PatchTree& tree, NodeId leaf) {
    const auto n = static_cast<std::size_t>(leaf);
    const Surface& s = tree.surfaces[static_cast<std::size_t>(tree.surface[n])];
    if (s.lamp != kNone) {
        tree.emission[n] = area_lamp_radiance(scene.lamps[static_cast<std::size_t>(s.lamp)]);
        return;
    }
    const Material& material = scene.materials[static_cast<std::size_t>(s.material)];
    tree.albedo[n] = material.albedo;
    tree.emission[n] = material.emission;
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
    tree.albedo[n] = albedo / static_cast<float>(kTextureSamples * kTextureSamples);
    tree.emission[n] = emission / static_cast<float>(kTextureSamples * kTextureSamples);
}

}  // namespace

PatchTree GrowingTree::finish(const Scene& scene, std::vector<NodeId>& renumbered) const {
    PatchTree tree;
    const std::size_t count = nodes_.size();
    tree.surfaces = surfaces_;
    tree.parent.resize(count);
    tree.subtree_end.resize(count);
    tree.depth.resize(count);
    tree.surface.resize(count);
    tree.region.resize(count);
    tree.center.resize(count);
    tree.normal.resize(count);
    tree.area.resize(count);
    tree.radius.resize(count);
    tree.cone_cosine.resize(count);
    tree.albedo.assign(count, vec3(0));
    tree.emission.assign(count, vec3(0));
    tree.exposed.assign(count, 1);
    tree.exposed_mask.assign(count, 0xFFFF);
    tree.surface_node.assign(surfaces_.size(), kNone);
    tree.triangle_surface.assign(scene.triangles.size(), {kNone, kNone});
    renumbered.assign(count, kNone);

    // Preorder: children go onto the stack in reverse.
    std::vector<NodeId> stack{kRoot};
    NodeId next = 0;
    while (!stack.empty()) {
        const NodeId old = stack.back();
        stack.pop_back();
        const GrowingNode& n = node(old);
        const NodeId id = next++;
        const auto i = static_cast<std::size_t>(id);
        renumbered[static_cast<std::size_t>(old)] = id;
        tree.parent[i] = n.parent == kNone ? kNone : renumbered[static_cast<std::size_t>(n.parent)];
        tree.depth[i] =
            n.parent == kNone ? 0 : tree.depth[static_cast<std::size_t>(tree.parent[i])] + 1;
        tree.subtree_end[i] = id + 1;
        tree.surface[i] = n.surface;
        tree.region[i] = n.region;
        tree.center[i] = n.center;
        tree.normal[i] = n.normal;
        tree.area[i] = n.area;
        tree.radius[i] = n.radius;
        tree.cone_cosine[i] = n.cone_cosine;
        if (n.surface != kNone) {
            NodeId& whole = tree.surface_node[static_cast<std::size_t>(n.surface)];
            if (whole == kNone) whole = id;
        }
        if (n.is_leaf()) tree.leaves.push_back(id);
        for (std::int32_t c = n.child_count; c-- > 0;)
            stack.push_back(n.first_child + c);
    }
    for (std::size_t i = count; i-- > 1;) {
        NodeId& end = tree.subtree_end[static_cast<std::size_t>(tree.parent[i])];
        end = std::max(end, tree.subtree_end[i]);
    }
    for (std::size_t s = 0; s < surfaces_.size(); ++s) {
        for (const TriangleId t : surfaces_[s].triangles) {
            if (t != kNone)
                tree.triangle_surface[static_cast<std::size_t>(t)][surfaces_[s].back_side ? 1 : 0] =
                    static_cast<SurfaceId>(s);
        }
    }
    for (const NodeId leaf : tree.leaves)
        set_material(scene, tree, leaf);
    pull_area_average<vec3>(tree, tree.albedo);
    pull_area_average<vec3>(tree, tree.emission);
    return tree;
}

}  // namespace antiradiance
