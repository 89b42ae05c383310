// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a render that depends on geometry alone: hierarchy, link mesh and visibility.
#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "hierarchy/patch_tree.h"
#include "links/link_set.h"
#include "links/tested_pairs.h"
#include "links/visibility.h"
#include "pipeline/blocker_cuts.h"
#include "pipeline/options.h"
#include "scene/ray_scene.h"

namespace antiradiance {

struct Model {
    RayScene rays;
    BlockingPlanes planes{};
    PatchTree tree{};
    LinkSet links{};
    std::vector<float> row_scale{};  // #nodes: EXPLICIT's row normalisation, else 1
    BlockerCuts cuts{};
    std::vector<std::string> warnings{};
    double hierarchy_seconds = 0;
    double links_seconds = 0;       // refinement, form factors, sorting
    double visibility_seconds = 0;  // rays
    std::size_t link_rays = 0;      // that tested the links, in EXPLICIT
    TestedPairs tested{};           // what they found, if it was to be kept
};

// Whether the direction of light matters: links are then sorted by as many bins as the options ask
// for. So where antiradiance is solved for or shot in the picture, and where bins are the
// visibility.
[[nodiscard]] bool needs_directions(const Options& options);

// How rays test the links of a scene.
[[nodiscard]] VisibilityRays visibility_rays(const Options& options);

// What a model may take over from an earlier state of the scene.
struct ModelReuse {
    bool keep = false;  // fill Model::tested, for the next one
    // Null: nothing.
    const Scene* scene = nullptr;
    const Model* model = nullptr;
};

// `scene` is valid (see validate()); coarseness: as in StageInput. Throws SceneError when the
// patches or links would not fit into memory, before they are made.
Model build_model(const Scene& scene, const Options& options, Progress& progress,
                  float coarseness = 1, const ModelReuse& reuse = {});

}  // namespace antiradiance
