// SPDX-License-Identifier: GPL-3.0-or-later
// From the solution to a picture: a G-buffer with direct light per pixel, then the indirect light
// by one of the display modes. A new mode is a function and a row of the table in display.cpp.
#pragma once

#include <span>
#include <vector>

#include "base/progress.h"
#include "display/display_backend.h"
#include "display/display_options.h"
#include "hierarchy/patch_tree.h"
#include "links/blocking_planes.h"
#include "links/link_set.h"
#include "scene/ray_scene.h"
#include "solve/direct_light.h"

namespace antiradiance {

struct Picture {
    int width = 0, height = 0;   // pixels of the camera's border
    std::vector<vec4> combined;  // #pixels, linear Rec.709, premultiplied, row 0 below
    std::vector<float> depth;    // #pixels, m along the view axis as in Blender's Z pass; 1e10:
                                 // nothing
    std::vector<vec3> normal;    // #pixels, world space, unit or 0
};

struct DisplayInput {
    const Scene& scene;  // its own camera is not read
    const Camera& camera;
    const RayScene& rays;
    const BlockingPlanes& planes;  // no patch lights a fragment through them
    const PatchTree& tree;
    const LinkSet& links;       // of the solution
    const LinkSet* linked;      // a fragment is lit by what these link to its leaf; null: by all
    const DirectLight& direct;  // evaluated per pixel
    std::span<const vec3> leaf_direct;  // #nodes, W/m2 of it on each leaf
    std::span<const vec3> irradiance;   // #nodes, W/m2 that links brought to each leaf
    std::span<const vec3> radiance;     // #nodes, W/(m2 sr), L of Eq. 3
    bool film_transparent = false;      // no background, alpha 0 where nothing is seen
    int samples_per_axis = 4;           // anti-aliasing, n x n a pixel
    // Pixels have the direct light of leaves, by the same mode, and trace no shadow rays: quick,
    // and shadows are as coarse as the leaves. Not for kFinalShooting.
    bool direct_of_leaves = false;
};

// Whether there is work for a back end: flat patches have none, and shadow rays stay on the CPU.
[[nodiscard]] bool uses_backend(const DisplayOptions& options);

[[nodiscard]] Picture make_picture(const DisplayInput& input, const DisplayOptions& options,
                                   DisplayBackend& backend, Progress& progress);

}  // namespace antiradiance
