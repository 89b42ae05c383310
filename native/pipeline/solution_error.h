// SPDX-License-Identifier: GPL-3.0-or-later
// How far solutions over several link sets of one mesh lie from operator G's on the same + links:
// what implicit visibility and pruning cost, apart from all errors of meshing.
#pragma once

#include <span>
#include <vector>

#include "base/progress.h"
#include "pipeline/model.h"
#include "pipeline/options.h"
#include "pipeline/transport_input.h"
#include "scene/scene.h"
#include "solve/solver.h"

namespace antiradiance {

// Of the irradiance (direct and indirect) over all leaves, weighted by area and clipped at four
// times the reference's median.
struct SolutionError {
    double relative_rms = 0;   // rms(A - B) / mean(B)
    double bias = 0;           // mean(A) / mean(B) - 1
    double largest_leak = 0;   // max(A - B) / mean(B): light where there should be none
    bool converged = false;    // both solutions
    float least_radiance = 0;  // W/(m2 sr), of both solutions
};

struct ExplicitLinks {
    LinkSet links;
    std::size_t rays = 0;  // that weighted them
};
// The + links of an IMPLICIT model, each weighted by rays; no - links.
[[nodiscard]] ExplicitLinks explicit_links(const Model& implicit, const VisibilityRays& rays,
                                           Progress& progress);

struct ReferenceRays {
    VisibilityRays rays;
    bool normalised = false;  // rows, as EXPLICIT does
};

class ReferenceSolution {
public:
    // model: of IMPLICIT. The reference is that of its explicit_links(). Borrows the model. Throws
    // what the solver throws.
    ReferenceSolution(const Scene& scene, const Options& options, const Model& model,
                      const ReferenceRays& rays, Progress& progress);

    // links: the model's, or made of them. row_scale: #nodes; empty: 1.
    [[nodiscard]] SolutionError error_of(const LinkSet& links, std::span<const float> row_scale,
                                         Progress& progress) const;
    [[nodiscard]] SolutionError error_of(const LinkSet& links, Progress& progress) const {
        return error_of(links, {}, progress);
    }

    [[nodiscard]] SolutionError error_of(const Solution& test) const;

    [[nodiscard]] Solution solve(const LinkSet& links, std::span<const float> row_scale,
                                 Progress& progress) const;
    [[nodiscard]] const Solution& solution() const { return solution_; }
    [[nodiscard]] const TransportInput& input() const { return input_; }

private:
    Options options_;
    const Model& model_;
    std::vector<vec3> direct_;  // #nodes, W/m2
    TransportInput input_;
    Solution solution_;
};

}  // namespace antiradiance
