// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/solution_error.h"

#include <algorithm>
#include <cmath>

#include "links/link_pairs.h"
#include "pipeline/choose_solver.h"
#include "prune/prune.h"
#include "solve/direct_light.h"
#include "solve/row_normalisation.h"

namespace antiradiance {

namespace {

constexpr double kClip = 4;  // times the reference's median, as for pictures

struct LeafValue {
    double area;
    double test, reference;
};

// Area-weighted median of the reference.
double median_of(std::vector<LeafValue> values) {
    std::sort(values.begin(), values.end(),
              [](const LeafValue& a, const LeafValue& b) { return a.reference < b.reference; });
    double half = 0;
    for (const LeafValue& v : values)
        half += v.area / 2;
    for (const LeafValue& v : values) {
        half -= v.area;
        if (half <= 0) return v.reference;
    }
    return 0;
}

void measure(const PatchTree& tree, std::span<const vec3> direct, std::span<const vec3> test,
             std::span<const vec3> reference, SolutionError& error) {
    std::vector<LeafValue> values;
    for (const NodeId leaf : tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        const double area = static_cast<double>(tree.area[n]) * tree.exposed[n];
        if (tree.emits_only(leaf) || area <= 0) continue;
        for (int k = 0; k < 3; ++k)
            values.push_back({area, direct[n][k] + test[n][k], direct[n][k] + reference[n][k]});
    }
    const double limit = kClip * median_of(values);
    double area = 0;
    double squares = 0;
    double leak = 0;
    double test_sum = 0;
    double reference_sum = 0;
    for (const LeafValue& v : values) {
        const double a = std::min(v.test, limit);
        const double b = std::min(v.reference, limit);
        area += v.area;
        squares += v.area * (a - b) * (a - b);
        leak = std::max(leak, a - b);
        test_sum += v.area * a;
        reference_sum += v.area * b;
    }
    if (reference_sum <= 0) return;
    error.relative_rms = std::sqrt(squares / area) / (reference_sum / area);
    error.bias = test_sum / reference_sum - 1;
    error.largest_leak = leak / (reference_sum / area);
}

float least_component(std::span<const vec3> radiance) {
    float least = 0;
    for (const vec3& l : radiance)
        least = std::min({least, l.x, l.y, l.z});
    return least;
}

}  // namespace

ExplicitLinks explicit_links(const Model& implicit, const VisibilityRays& rays,
                             Progress& progress) {
    LinkPairs pairs = pair_links(implicit.tree, implicit.links);
    ExplicitLinks result;
    result.rays = count_rays(implicit.tree, rays, pairs.pairs);
    const std::vector<float> visibility =
        trace_pairs(implicit.tree, implicit.rays, pairs.pairs, progress);
    LinkSet links = implicit.links;
    const RemovedLinks gone = weigh_links(links, pairs, visibility);
    result.links = remove_links(std::move(links), gone);
    return result;
}

ReferenceSolution::ReferenceSolution(const Scene& scene, const Options& options, const Model& model,
                                     const ReferenceRays& rays, Progress& progress)
    : options_(options), model_(model) {
    const DirectLight light(scene, model.rays, options.direct_light, progress);
    direct_ = light.leaf_irradiance(model.tree, progress);
    input_ = make_transport_input(scene, model.tree, direct_, options.direct_light);
    const LinkSet links = explicit_links(model, rays.rays, progress).links;
    std::vector<float> row_scale;
    if (rays.normalised)
        row_scale = row_scales(model.tree, links, {}, model.rays, model.planes, progress);
    solution_ = solve(links, row_scale, progress);
}

Solution ReferenceSolution::solve(const LinkSet& links, std::span<const float> row_scale,
                                  Progress& progress) const {
    SolveOptions solve;
    solve.iterations = options_.iterations;
    const TransportProblem problem =
        input_.problem(model_.tree, links, row_scale.empty() ? model_.row_scale : row_scale);
    return solve_transport(options_.solver, problem, solve, progress).solution;
}

SolutionError ReferenceSolution::error_of(const LinkSet& links, std::span<const float> row_scale,
                                          Progress& progress) const {
    return error_of(solve(links, row_scale, progress));
}

SolutionError ReferenceSolution::error_of(const Solution& test) const {
    SolutionError error;
    measure(model_.tree, direct_, test.irradiance, solution_.irradiance, error);
    error.converged = test.converged && solution_.converged;
    error.least_radiance =
        std::min(least_component(test.radiance), least_component(solution_.radiance));
    return error;
}

}  // namespace antiradiance
