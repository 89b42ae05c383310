// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/evaluate_blockers.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "links/cut_links.h"
#include "pipeline/helpful_blockers.h"
#include "pipeline/model.h"
#include "prune/evaluate.h"
#include "prune/prune.h"
#include "prune/ray_visibility.h"
#include "scene/validate.h"

namespace antiradiance {

namespace {

// Counts a link by its sign.
void count(const Link& link, LinkCount& sum) {
    ++(link.form_factor > 0 ? sum.radiance : sum.antiradiance);
}

std::vector<std::uint8_t> where(std::span<const BlockerId> cut, bool is_cut) {
    std::vector<std::uint8_t> result(cut.size());
    std::ranges::transform(cut, result.begin(), [is_cut](BlockerId plane) {
        return static_cast<std::uint8_t>((plane != kNone) == is_cut);
    });
    return result;
}

// #links, 1: no ray gets through.
std::vector<std::uint8_t> find_occluded(const Scene& scene, const Model& model,
                                        std::span<const BlockerId> cut,
                                        const BlockerEvaluationOptions& how, Progress& progress) {
    const auto trace = [&](const LinkSet& links) {
        return invisible_links(trace_visibility(scene, model.tree, links, model.rays,
                                                {.rays_per_link = how.rays}, progress));
    };
    if (how.all_links) return trace(model.links);
    const RemovedLinks of_cut = trace(remove_links(model.links, where(cut, false)));
    RemovedLinks occluded(cut.size(), 0);
    auto next = of_cut.begin();
    for (std::size_t l = 0; l < cut.size(); ++l) {
        if (cut[l] != kNone) occluded[l] = *next++;
    }
    return occluded;
}

void test_with_rays(const Scene& scene, const Model& model, std::span<const BlockerId> cut,
                    const BlockerEvaluationOptions& how, BlockerEvaluation& evaluation,
                    Progress& progress) {
    const auto plane = [&](std::size_t l) -> BlockerEvaluation::Plane& {
        return evaluation.per_plane[static_cast<std::size_t>(cut[l])];
    };
    std::vector<std::uint8_t> free(cut.size(), 0);  // no surface between the centres
    parallel_for_blocks(
        model.links.segments.size(), 1024, progress, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const Segment& row = model.links.segments[i];
                for (std::uint32_t l = row.begin; l < row.end; ++l) {
                    const Link& link = model.links.links[l];
                    if (cut[l] != kNone && link.form_factor > 0)
                        free[l] = centers_see(model.tree, model.rays, link.source, row.receiver);
                }
            }
        });
    for (std::size_t l = 0; l < free.size(); ++l) {
        if (free[l]) ++plane(l).wrongly_cut;
    }
    const std::vector<std::uint8_t> occluded = find_occluded(scene, model, cut, how, progress);
    LinkCount all;
    for (std::size_t l = 0; l < cut.size(); ++l) {
        if (!occluded[l]) continue;
        count(model.links.links[l], all);
        if (cut[l] != kNone) count(model.links.links[l], plane(l).occluded_cut);
    }
    if (how.all_links) evaluation.occluded = all;
}

void compare_light(const Scene& scene, const Options& options, const Model& model,
                   const BlockingPlanes& planes, std::span<const BlockerId> cut,
                   BlockerEvaluation& evaluation, Progress& progress) {
    constexpr int kReferenceRays = 16;  // a + link, as in an evaluation of pruning
    const ReferenceSolution reference(scene, options, model, {{kReferenceRays}}, progress);
    const Solution without = reference.solve(model.links, {}, progress);
    evaluation.without_planes = reference.error_of(without);
    evaluation.with_planes =
        reference.error_of(remove_links(model.links, where(cut, true)), progress);

    std::vector<vec3> error = without.irradiance;
    for (std::size_t n = 0; n < error.size(); ++n)
        error[n] -= reference.solution().irradiance[n];
    const std::vector<std::uint8_t> helps =
        find_helpful_blockers(model.tree, model.links, planes, evaluation.per_plane.size(), cut,
                              without.radiance, error, progress);
    for (std::size_t b = 0; b < helps.size(); ++b)
        evaluation.per_plane[b].helps = helps[b] != 0;
}

}  // namespace

BlockerEvaluation evaluate_blockers(Scene scene, Options options,
                                    const BlockerEvaluationOptions& how, Progress& progress) {
    validate(scene);
    const std::vector<Blocker> blockers = std::exchange(scene.blockers, {});
    options.visibility = Visibility::kImplicit;
    BlockerEvaluation evaluation;
    for (const Blocker& blocker : blockers)
        evaluation.per_plane.emplace_back().name = blocker.name;
    const Model model = build_model(scene, options, progress);
    if (model.tree.size() == 0) return evaluation;
    evaluation.links = {model.links.radiance_count, model.links.antiradiance_count};

    progress.begin_stage("Evaluating blocking planes", 0.45F, 1);
    Stopwatch watch;
    const BlockingPlanes planes(blockers, model.rays.epsilon());
    const std::vector<BlockerId> cut = find_cut_links(model.tree, model.links, planes, progress);
    evaluation.seconds = watch.lap();
    for (std::size_t l = 0; l < cut.size(); ++l) {
        if (cut[l] != kNone)
            count(model.links.links[l], evaluation.per_plane[static_cast<std::size_t>(cut[l])].cut);
    }
    if (how.rays > 0) test_with_rays(scene, model, cut, how, evaluation, progress);
    if (how.light) compare_light(scene, options, model, planes, cut, evaluation, progress);
    return evaluation;
}

}  // namespace antiradiance
