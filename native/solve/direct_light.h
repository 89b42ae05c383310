// SPDX-License-Identifier: GPL-3.0-or-later
// Light that arrives at a point straight from lamps and emissive meshes, with shadow rays.
#pragma once

#include <memory>
#include <vector>

#include "base/progress.h"
#include "hierarchy/patch_tree.h"
#include "scene/ray_scene.h"
#include "scene/scene.h"
#include "solve/solve_options.h"

namespace antiradiance {

class DirectLight {
public:
    // mode kImplicit leaves emissive meshes and area lamps out: they emit along links.
    // Borrows both, which must outlive it.
    DirectLight(const Scene& scene, const RayScene& rays, DirectLightMode mode);
    ~DirectLight();

    // False: irradiance() is 0 everywhere.
    [[nodiscard]] bool any() const;

    // Irradiance, W/m2, at a surface point seen from the side of `normal` (unit). About `samples`
    // shadow rays for each light (emissive polygons beyond a count are chosen by their power).
    // Deterministic in `seed`: index `sample_index` of a pixel's or a patch's samples continues one
    // low-discrepancy sequence. From any thread.
    [[nodiscard]] vec3 irradiance(const vec3& point, const vec3& normal, int samples,
                                  std::uint32_t sample_index, std::uint32_t seed) const;

    // Area average over every leaf's exposed part, W/m2.           // #nodes; 0 at inner nodes
    [[nodiscard]] std::vector<vec3> leaf_irradiance(const PatchTree& tree,
                                                    Progress& progress) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace antiradiance
