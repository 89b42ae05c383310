// SPDX-License-Identifier: GPL-3.0-or-later
// What the camera sees, with all that does not depend on the display mode already lit.
#pragma once

#include <span>
#include <vector>

#include "base/parallel.h"
#include "hierarchy/patch_tree.h"
#include "scene/ray_scene.h"
#include "scene/scene.h"
#include "solve/direct_light.h"

namespace antiradiance {

// The part of a pixel that shows one surface, or one leaf of it, or one triangle side that no light
// reaches. All anti-aliasing samples that meet it are shaded as one: a display mode is evaluated
// once a fragment, about 1.3 times a pixel, and edges are as smooth as all the samples.
struct Fragment {
    std::uint32_t pixel = 0;  // into GBuffer's images
    NodeId leaf = kNone;      // of its first sample; kNone: no link reaches this side
    float coverage = 0;       // share of the pixel, 0..1
    vec3 position{0};         // m, mean of its samples
    vec3 normal{0};           // unit, of the geometry, towards the viewer
    vec3 shading_normal{0};   // unit
    vec3 albedo{0};           // mean of its samples, 0..1, of the original mesh and its textures
    vec3 light{0};            // emission and reflected direct light, W/(m2 sr)
};

struct GBuffer {
    int width = 0, height = 0;        // pixels of the camera's border
    std::vector<Fragment> fragments;  // by pixel
    // Images, row 0 below:                                                           // #pixels
    std::vector<vec4> background;  // where no surface is seen: radiance x coverage, alpha
    std::vector<float> depth;      // m along the view axis; 1e10: nothing
    std::vector<vec3> normal;      // world space, mean over the pixel's surfaces, unit or 0
};

// Where each pixel's fragments begin, and the end.  // #pixels + 1, into GBuffer::fragments
[[nodiscard]] std::vector<std::uint32_t> pixel_starts(const GBuffer& buffer);

struct GBufferInput {
    const Scene& scene;  // its own camera is not read
    const Camera& camera;
    const RayScene& rays;
    const PatchTree& tree;
    const DirectLight* direct;          // null: fragments have emission alone
    std::span<const vec3> leaf_direct;  // #nodes, W/m2 of direct light on each leaf
    std::span<const vec3> irradiance;   // #nodes, W/m2 over links on each leaf
    bool by_leaf;                       // a fragment for each leaf, not for each surface
    bool film_transparent;              // alpha 0 and no radiance where nothing is seen
    int samples_per_axis;               // anti-aliasing: n x n jittered samples a pixel, box filter
    int direct_samples;                 // of DirectSampling, for a whole pixel
};

[[nodiscard]] GBuffer make_gbuffer(const GBufferInput& input, Progress& progress,
                                   ProgressSpan span);

}  // namespace antiradiance
