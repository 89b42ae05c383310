// SPDX-License-Identifier: GPL-3.0-or-later
// Light that arrives at a point straight from lamps and emissive meshes, with shadow rays.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "hierarchy/patch_tree.h"
#include "hierarchy/scene_change.h"
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
// All points, those of spread_choice() first.
[[nodiscard]] std::vector<SurfacePoint> spread_first(std::span<const SurfacePoint> points,
                                                     std::size_t count);

// How DirectLight::irradiance() samples.
struct DirectSampling {
    // Shadow rays for each light, about: at least one from each point, fewer for weak lights, and
    // up to kMostFactor times as many where its shadow edge crosses the points. Many lights share
    // them by the light they can bring.
    int samples = 16;
    // Standard error at which rays end, relative to all light: an eye sees about 0.02.
    float tolerance = 0.01F;
    // Luminance of the direct light on what is around, W/m2, or 0. Points that seem to get less
    // than half of it look for hidden lights with all rays: through a slit, most pixels would miss
    // a light and some find it.
    float expected = 0;
    // Luminance of the light that comes another way, W/m2: it hides noise.
    float indirect = 0;

    static constexpr int kMostFactor = 16;
};

// A lamp, or a material that emits.
struct LightSource {
    std::int32_t lamp = kNone;      // into Scene::lamps
    std::int32_t material = kNone;  // into Scene::materials

    bool operator==(const LightSource&) const = default;
};

// How much of the leaves' direct light comes from where.
struct LightShares {
    std::vector<LightSource> lights;
    std::vector<std::vector<vec3>> irradiance;  // W/m2  // #lights x #nodes; 0 at inner nodes

    // Of more lights than this no shares are kept: their memory grows with each.
    static constexpr std::size_t kMostLights = 32;
};

// Direct light of the leaves in an earlier state of the scene, whose lights were the same.
struct EarlierLight {
    const SceneChange& change;
    const PatchTree& tree;
    const std::vector<vec3>& irradiance;  // #nodes of `tree`, W/m2
    const LightShares& shares;            // of it
};

class DirectLight {
public:
    // mode kImplicit leaves emissive meshes and area lamps out: they emit along links. kShadowMaps
    // draws the maps, and throws SceneError where OpenGL is missing or fails.
    // Borrows the rays, which must outlive it.
    DirectLight(const Scene& scene, const RayScene& rays, DirectLightMode mode, Progress& progress);
    ~DirectLight();

    // False: irradiance() is 0 everywhere.
    [[nodiscard]] bool any() const;

    // Mean irradiance, W/m2, over points of one surface that lie close together (those of a pixel).
    // Deterministic in `seed`. From any thread.
    [[nodiscard]] vec3 irradiance(std::span<const SurfacePoint> points,
                                  const DirectSampling& sampling, std::uint32_t seed) const;

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
    // shares: its parts, unless it is null; without lights where there are none, too many or maps.
    // tolerance: standard error at which rays end, relative.
    // earlier: leaves that see all lights past nothing that has changed keep their light, unless
    // it is null; ignored with maps.
    [[nodiscard]] std::vector<vec3> leaf_irradiance(const PatchTree& tree, Progress& progress,
                                                    LightShares* shares = nullptr,
                                                    float tolerance = kLeafTolerance,
                                                    const EarlierLight* earlier = nullptr) const;
    static constexpr float kLeafTolerance = 0.01F;

    struct Impl;  // direct_light_estimate.h

private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace antiradiance
