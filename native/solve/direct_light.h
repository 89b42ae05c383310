// SPDX-License-Identifier: GPL-3.0-or-later
// Light that arrives at a point straight from lamps and emissive meshes, with shadow rays.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "hierarchy/patch_tree.h"
#include "scene/ray_scene.h"
#include "scene/scene.h"
#include "solve/solve_options.h"

namespace antiradiance {

// A point that receives light.
struct SurfacePoint {
    vec3 position;        // m
    vec3 normal;          // unit, of the geometry, on the side that is lit
    vec3 shading_normal;  // unit; sets the cosine, while `normal` sets the horizon
};

// `count` of the points of a square grid, which come in rows, those along its diagonal: one of each
// stretch, later ones of later stretches. All of them when they are no more.
[[nodiscard]] std::vector<SurfacePoint> spread_choice(std::span<const SurfacePoint> points,
                                                      std::size_t count);

class DirectLight {
public:
    static constexpr int kMostSamplesFactor = 16;

    // mode kImplicit leaves emissive meshes and area lamps out: they emit along links. kShadowMaps
    // draws the maps, and throws SceneError where OpenGL is missing or fails.
    // Borrows the rays, which must outlive it.
    DirectLight(const Scene& scene, const RayScene& rays, DirectLightMode mode, Progress& progress);
    ~DirectLight();

    // False: irradiance() is 0 everywhere.
    [[nodiscard]] bool any() const;

    // Mean irradiance, W/m2, over points of one surface that lie close together (those of a pixel).
    // Takes about `samples` shadow rays for each light, at least one from each point, and up to
    // kMostSamplesFactor times `samples` where its shadow edge crosses the points; a large number
    // of lights shares them by the light they can bring.
    // expected: luminance of what the surroundings get, W/m2, or 0. Points that seem to get less
    // than half of it look for hidden lights with all rays: through a slit, most pixels would miss
    // a light and some find it. Deterministic in `seed`. From any thread.
    [[nodiscard]] vec3 irradiance(std::span<const SurfacePoint> points, int samples, float expected,
                                  std::uint32_t seed) const;

    // In mode kShadowMaps the way to ask is not irradiance() but, for many groups of points at
    // once, mapped_irradiance(). From one thread.
    [[nodiscard]] bool has_maps() const;
    // Mean irradiance, W/m2, over each group of points: group g is [ends[g - 1], ends[g]).  //
    // #ends
    [[nodiscard]] std::vector<vec3> mapped_irradiance(std::span<const SurfacePoint> points,
                                                      std::span<const std::uint32_t> ends,
                                                      Progress& progress, ProgressSpan span) const;
    struct Maps {
        std::size_t images = 0;
        std::size_t bytes = 0;
    };
    [[nodiscard]] Maps maps() const;  // none in the other modes

    // Area average over every leaf's exposed part, W/m2.           // #nodes; 0 at inner nodes
    [[nodiscard]] std::vector<vec3> leaf_irradiance(const PatchTree& tree,
                                                    Progress& progress) const;

    struct Impl;  // direct_light_estimate.h

private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace antiradiance
