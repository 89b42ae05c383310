// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/evaluate_rules.h"

#include "base/stopwatch.h"
#include "prune/prune.h"
#include "prune/ray_visibility.h"
#include "scene/validate.h"

namespace antiradiance {

PruningTable evaluate_rules(const Scene& scene, const Options& options, const Model& model,
                            const EvaluationRays& rays, Progress& progress) {
    PruningTable table;
    table.patches = model.tree.leaves.size();
    table.links = model.links.links.size();
    if (table.patches == 0) return table;

    Stopwatch watch;
    const RemovedLinks invisible = invisible_links(trace_visibility(
        scene, model.tree, model.links, model.rays, {.rays_per_link = rays.truth}, progress));
    table.explicit_seconds = watch.lap();
    for (const std::uint8_t gone : invisible)
        table.explicit_test += gone;

    const ReferenceSolution reference(scene, options, model, {{rays.reference}}, progress);
    table.unpruned = reference.error_of(model.links, progress);
    for (const PruneRule& rule : prune_rules()) {
        if (rule.traces_rays) continue;
        watch.lap();
        const RemovedLinks removed = find_removed_links(
            {scene, model.tree, model.links, model.rays},
            {.method = rule.method, .directions = options.pruning_directions}, progress);
        const double seconds = watch.lap();
        table.rules.push_back(
            {rule.identifier,
             evaluate_pruning(model.tree, model.links, removed, invisible, seconds),
             reference.error_of(remove_links(model.links, removed), progress)});
    }
    return table;
}

PruningTable evaluate_rules(Scene scene, Options options, const EvaluationRays& rays,
                            Progress& progress) {
    validate(scene);
    options.visibility = Visibility::kImplicit;
    const Model model = build_model(scene, options, progress);
    return evaluate_rules(scene, options, model, rays, progress);
}

}  // namespace antiradiance
