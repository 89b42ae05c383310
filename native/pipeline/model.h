// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a render that depends on geometry alone: hierarchy, link mesh and visibility.
#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "hierarchy/patch_tree.h"
#include "links/link_set.h"
#include "pipeline/options.h"
#include "scene/ray_scene.h"

namespace antiradiance {

struct Model {
    RayScene rays;
    PatchTree tree;
    LinkSet links;
    std::vector<float> row_scale;  // #nodes: EXPLICIT's row normalisation, 1 in IMPLICIT
    std::vector<std::string> warnings;
    double hierarchy_seconds = 0;
    double links_seconds = 0;       // refinement, form factors, sorting
    double visibility_seconds = 0;  // rays
};

// Whether antiradiance is solved for, or shot in the picture: links are then made for the direction
// of their light.
[[nodiscard]] bool needs_directions(const Options& options);

// `scene` is valid (see validate()). Throws SceneError when the patches or links would not fit into
// memory, before they are made.
Model build_model(const Scene& scene, const Options& options, Progress& progress);

}  // namespace antiradiance
