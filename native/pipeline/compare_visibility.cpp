// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/compare_visibility.h"

#include "base/stopwatch.h"
#include "links/shortest_links.h"
#include "pipeline/model.h"
#include "pipeline/stage_input.h"
#include "prune/prune.h"
#include "scene/validate.h"
#include "solve/mixed_visibility.h"
#include "solve/row_normalisation.h"

namespace antiradiance {

namespace {

struct WayLinks {
    LinkSet links;
    std::vector<float> row_scale;  // #nodes; empty: 1
    std::size_t rays = 0;
};

WayLinks links_of(const Scene& scene, const Options& way, const Model& model,
                  const TransportInput& input, Progress& progress) {
    WayLinks result;
    switch (way.visibility) {
        case Visibility::kExplicit: {
            ExplicitLinks tested = explicit_links(model, visibility_rays(way), progress);
            result.links = std::move(tested.links);
            result.rays = tested.rays;
            result.row_scale =
                row_scales(model.tree, result.links, {}, model.rays, model.planes, progress);
            return result;
        }
        case Visibility::kDiscrete:
            result.links =
                remove_links(model.links, all_but_shortest(model.tree, model.links, progress));
            return result;
        case Visibility::kImplicit:
        case Visibility::kMixed:
            break;
    }
    result.links =
        prunes(way)
            ? prune_links({scene, model.tree, model.links, model.rays},
                          {.method = way.pruning, .directions = way.pruning_directions}, progress)
                  .links
            : model.links;
    if (way.visibility == Visibility::kMixed) {
        MixedVisibility mixed =
            mix_visibility(input.problem(model.tree, result.links, model.row_scale), model.rays,
                           model.planes, {way.ray_budget, visibility_rays(way)}, progress);
        result = {std::move(mixed.links), std::move(mixed.row_scale), mixed.rays};
    }
    return result;
}

}  // namespace

std::vector<VisibilityError> compare_visibility(Scene scene, std::span<const Options> ways,
                                                const ReferenceRays& reference,
                                                Progress& progress) {
    if (ways.empty()) return {};
    validate(scene);
    Options options = ways.front();
    options.visibility = Visibility::kImplicit;
    const Model model = build_model(scene, options, progress);
    std::vector<VisibilityError> errors(ways.size());
    if (model.tree.size() == 0) return errors;
    const ReferenceSolution truth(scene, options, model, reference, progress);
    for (std::size_t i = 0; i < ways.size(); ++i) {
        Stopwatch watch;
        const WayLinks way = links_of(scene, ways[i], model, truth.input(), progress);
        VisibilityError& error = errors[i];
        static_cast<SolutionError&>(error) = truth.error_of(way.links, way.row_scale, progress);
        error.seconds = watch.lap();
        error.leaves = model.tree.leaves.size();
        error.links = way.links.links.size();
        error.rays = way.rays;
    }
    return errors;
}

}  // namespace antiradiance
