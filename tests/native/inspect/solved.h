// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes taken through all stages before the picture.
#pragma once

#include <utility>

#include "pipeline/stages.h"
#include "scene/validate.h"
#include "support/scene_builder.h"
#include "support/scenes.h"

namespace antiradiance::test {

inline SolvedScene solve(Scene scene, const Options& options) {
    validate(scene);
    Progress progress;
    Report report;
    return Stages().run({.scene = std::move(scene), .options = options}, progress, report);
}

// Patches of a metre: some hundreds, so that a test takes no second.
inline Options coarse(Visibility visibility) {
    Options options;
    options.visibility = visibility;
    options.max_patch_size = 1;
    options.link_threshold = 0.1F;
    options.solver = SolverChoice::kCpu;
    return options;
}

inline const SolvedScene& solved_office(Visibility visibility) {
    static const SolvedScene is_explicit = solve(office(), coarse(Visibility::kExplicit));
    static const SolvedScene is_implicit = solve(office(), coarse(Visibility::kImplicit));
    return visibility == Visibility::kExplicit ? is_explicit : is_implicit;
}

// Two plates that hang above each other in the dark, all fronts up but that of the shining one at
// the top: Mückl & Dachsbacher, Fig. 2. Each is one patch.
struct Plates {
    static constexpr int kLight = 0, kMiddle = 1, kLowest = 2;  // objects

    // m, how far the middle one is moved aside: by 1 it hides half of the light.
    explicit Plates(float aside) {
        Scene scene;
        const int grey = add_material(scene, vec3(0.5F));
        const int shining = add_material(scene, vec3(0), vec3(10));
        add_quad(scene, "Light", {0, 0, 2}, {0, 2, 0}, {2, 0, 0}, shining);
        add_quad(scene, "Middle", {aside, 0, 1}, {2, 0, 0}, {0, 2, 0}, grey);
        add_quad(scene, "Lowest", {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, grey);
        add_point_lamp(scene, {5, 1, 0.5F}, vec3(1));  // or no light would reach the shadow
        Options options = coarse(Visibility::kImplicit);
        options.max_patch_size = 4.1F;  // no link splits what is not longer than half of it
        options.direct_light = DirectLightMode::kImplicit;  // the light takes part in the links
        solved = solve(std::move(scene), options);
    }
    // The side of a plate that looks to `z`, +1 or -1.
    [[nodiscard]] NodeId leaf(int object, float z) const {
        const PatchTree& tree = solved.model->tree;
        for (const NodeId leaf : tree.leaves) {
            const auto n = static_cast<std::size_t>(leaf);
            const auto surface = static_cast<std::size_t>(tree.surface[n]);
            if (tree.surfaces[surface].object == object && tree.normal[n].z * z > 0) return leaf;
        }
        return kNone;
    }

    SolvedScene solved;
};

}  // namespace antiradiance::test
