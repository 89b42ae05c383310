// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of how a solution came about, for the viewport: a colour a leaf, drawn from any camera.
//
//   const Inspection inspection = inspect(solved, options, nullptr, progress);   // once a solution
//   Picture picture = draw(solved, inspection, camera, 1, progress);             // at each move
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "base/progress.h"
#include "display/display.h"
#include "pipeline/options.h"
#include "pipeline/solved_scene.h"
#include "scene/scene.h"

namespace antiradiance {

enum class InspectMode {
    kOff,
    kHierarchy,
    kIncomingBin,
    kResidual,
    kExplicitDifference,
};

// By InspectMode.
[[nodiscard]] std::span<const EnumItem> inspect_modes();

// What a colour of a mode means.
struct LegendEntry {
    vec3 colour;  // as in Inspection
    std::string_view meaning;
};

// Of modes whose colours stand for numbers, the largest first; of others empty.
[[nodiscard]] std::vector<LegendEntry> legend(InspectMode mode);

struct InspectOptions {
    InspectMode mode = InspectMode::kOff;
    int level = 0;  // of kHierarchy: steps above the leaves, 0.. (see ancestor())
    int bin = 0;    // of kIncomingBin: of solved.links(), 0..

    bool operator==(const InspectOptions&) const = default;
};

struct Inspection {
    std::vector<vec3> colour;     // #nodes, linear Rec.709; read at leaves
    std::vector<NodeId> patch{};  // #nodes, read at leaves: what is outlined; empty: nothing is
    bool shaded = false;          // a little darker where a surface turns away from the viewer
};

// kHierarchy: each patch of the level has a colour of its own, which it keeps from level to level.
// kIncomingBin: bin_irradiance() over the mean solid angle of a bin, W/(m2 sr), in grey: the
//     radiance that seems to come along the bin, times the cosine. So a leaf that faces a large
//     light is as bright as the light is in the picture, under the same exposure. Negative
//     luminance in red.
// kResidual: residuals() from black over red and yellow to white, logarithmic from 1e-6 to 1.
// kExplicitDifference: irradiance_differences(), white where it is 0, blue where `solved` is
//     darker, red where it is brighter, and full at half of the mean irradiance.
// The numbers are those of inspect/leaf_values.h. explicit_solution: of the same geometry, its
// visibility EXPLICIT and its other options those of `solved`; read by kExplicitDifference alone.
// Throws Cancelled; std::invalid_argument for kOff, or when an explicit_solution is missing or of
// other geometry.
[[nodiscard]] Inspection inspect(const SolvedScene& solved, const InspectOptions& options,
                                 const SolvedScene* explicit_solution, Progress& progress);

// `inspection`: of `solved`. Sides that no light reaches are black, and so is what lies beyond all
// surfaces, or transparent where the scene's film is. Lamps are not seen. Throws Cancelled.
[[nodiscard]] Picture draw(const SolvedScene& solved, const Inspection& inspection,
                           const Camera& camera, int samples_per_axis, Progress& progress);

}  // namespace antiradiance
