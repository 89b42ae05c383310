// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/model.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "base/error.h"
#include "base/memory.h"
#include "base/stopwatch.h"
#include "hierarchy/coverage.h"
#include "hierarchy/growing_tree.h"
#include "hierarchy/lit_sides.h"
#include "hierarchy/surfaces.h"
#include "links/build_link_set.h"
#include "links/estimate_links.h"
#include "links/refine.h"
#include "links/shortest_links.h"
#include "links/visibility.h"
#include "prune/prune.h"
#include "solve/row_normalisation.h"

namespace antiradiance {

namespace {

// Leaves that a scene gets at the default patch size before links split any, if all its surfaces
// were square. Rooms end at two to three times as many.
constexpr float kDefaultLeaves = 5000;
// Patches may be split for the sake of links down to this share of the patch size.
constexpr float kLeastEdge = 0.5F;
// Of the link threshold, for links that carry an emitter's light: on the Cornell box 3 % more links
// take the error against ray-tested ones from .157 to .141.
constexpr float kEmitterShare = 0.25F;
// Above this many surfaces EXPLICIT links clusters; below it polygons are a little more accurate
// (algorithm.md "Clusters").
constexpr std::size_t kClusterSurfaces = 4000;
constexpr int kFewestBins = 32;  // that DirectionBins takes

// Bytes, of all stages' arrays together at their peak.
constexpr double kBytesPerPatch = 600;
constexpr double kBytesPerLink = 56;
constexpr double kLinksPerPatch = 60;
constexpr double kMemoryShare = 0.8;  // of what is available

// IMPLICIT says beforehand when it will take more links than this, and how long at this rate.
constexpr double kManyLinks = 20e6;
constexpr double kLinksPerSecond = 1e6;  // from refinement to the solution, 2 cores

std::string gibibytes(double bytes) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.1f GiB", bytes / (1024.0 * 1024.0 * 1024.0));
    return text;
}

std::vector<Surface> lit_surfaces(const Scene& scene, const RayScene& rays, const Options& options,
                                  Progress& progress) {
    const std::vector<Polygon> polygons = make_polygons(scene);
    const auto lit = find_lit_sides(scene, rays, polygons, progress);
    std::vector<Surface> surfaces;
    for (std::size_t p = 0; p < polygons.size(); ++p) {
        for (const bool back_side : {false, true}) {
            if (lit[p][back_side ? 1 : 0])
                surfaces.push_back(make_surface(scene, polygons[p], back_side));
        }
    }
    if (options.direct_light == DirectLightMode::kImplicit) {
        for (std::size_t i = 0; i < scene.lamps.size(); ++i) {
            if (scene.lamps[i].type == LampType::kArea)
                surfaces.push_back(make_lamp_surface(scene.lamps[i], static_cast<std::int32_t>(i)));
        }
    }
    return surfaces;
}

float automatic_patch_size(const std::vector<Surface>& surfaces) {
    double area = 0;
    for (const Surface& s : surfaces)
        area += static_cast<double>(surface_area(s));
    return static_cast<float>(std::sqrt(area / kDefaultLeaves));
}

void check_memory(const Scene& scene, const std::vector<Surface>& surfaces, float patch_size) {
    const GrowingTree::Estimate estimate = GrowingTree::estimate_patches(surfaces, patch_size);
    const double needed = estimate.patches * (kBytesPerPatch + kLinksPerPatch * kBytesPerLink);
    const double available = kMemoryShare * static_cast<double>(available_memory_bytes());
    if (needed <= available) return;
    const std::string object =
        estimate.largest_object == kNone
            ? ""
            : ", most of them for '" +
                  scene.objects[static_cast<std::size_t>(estimate.largest_object)].name + "'";
    char patches[32];
    std::snprintf(patches, sizeof(patches), "%.3g", estimate.patches);
    throw SceneError("Max Patch Size " + std::to_string(patch_size) + " m would make " + patches +
                     " patches" + object + ", which need about " + gibibytes(needed) +
                     " of memory; " + gibibytes(available) + " are free: raise Max Patch Size");
}

// Directions that links are sorted by. Between patches EXPLICIT asks for none, and with the fewest
// bins it needs less memory and time for the same light; clusters send into each bin its own.
int link_bins(const Options& options, bool cluster_links) {
    return cluster_links || needs_directions(options) ? options.direction_bins : kFewestBins;
}

RefineOptions refine_options(const Options& options, float patch_size, std::size_t surfaces,
                             float coarseness) {
    RefineOptions refine;
    refine.link_threshold = coarseness * coarseness * options.link_threshold;
    refine.least_edge = kLeastEdge * patch_size;
    if (options.direct_light == DirectLightMode::kImplicit) refine.emitter_share = kEmitterShare;
    refine.antiradiance = options.has_antiradiance();
    refine.spread_touching = needs_directions(options);
    refine.cluster_links = options.visibility == Visibility::kExplicit &&
                           (surfaces > kClusterSurfaces || coarseness > 1);
    // As fine as direction_bins asks for, whatever the links are sorted by.
    refine.bin_share = static_cast<float>(link_bins(options, refine.cluster_links)) /
                       static_cast<float>(options.direction_bins);
    refine.most_links = static_cast<std::size_t>(std::min(
        kMemoryShare * static_cast<double>(available_memory_bytes()) / kBytesPerLink,
        static_cast<double>(std::numeric_limits<std::uint32_t>::max())));  // links are numbered so
    return refine;
}

std::string object_of_most(const Scene& scene, const std::vector<Surface>& surfaces) {
    std::map<std::int32_t, std::size_t> count;
    for (const Surface& s : surfaces) {
        if (s.object != kNone) ++count[s.object];
    }
    const auto most =
        std::max_element(count.begin(), count.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == count.end() ? "lamps"
                               : scene.objects[static_cast<std::size_t>(most->first)].name;
}

// Only EXPLICIT has clusters: else every surface links with every other that it can see, and a
// detailed model may be too much for it. Returns what to tell the artist before the work starts,
// empty where it is no burden; throws where the links can't fit into memory.
std::string check_implicit_links(const Scene& scene, const GrowingTree& tree,
                                 const Options& options, const RefineOptions& refine) {
    if (options.visibility == Visibility::kExplicit) return {};
    // They may cut most of them; whether the rest fits into memory shows as links are made.
    if (!refine.planes->empty()) return {};
    const double links = estimate_links_without_clusters(tree);
    if (links < kManyLinks) return {};
    char millions[32];
    std::snprintf(millions, sizeof(millions), "%.0f million", links / 1e6);
    const std::string what =
        "Visibility " + std::string(label_of(options, "visibility")) + " links each of " +
        std::to_string(tree.surfaces().size()) + " surfaces, most of them of '" +
        object_of_most(scene, tree.surfaces()) + "', with every other: at least " + millions +
        " links, " + gibibytes(links * kBytesPerLink) + " of memory";
    const std::string cure =
        ". Set Visibility to Explicit, which links groups of surfaces, or simplify the object";
    if (links > static_cast<double>(refine.most_links)) {
        throw SceneError(what + "; " +
                         gibibytes(static_cast<double>(refine.most_links) * kBytesPerLink) +
                         " are free" + cure);
    }
    char minutes[32];
    std::snprintf(minutes, sizeof(minutes), " and %.1f minutes", links / kLinksPerSecond / 60);
    return what + minutes + cure;
}

// Buried leaves take no part: no link may start or end at one.
void drop_buried(const PatchTree& tree, std::vector<RawLink>& links) {
    for (RawLink& l : links) {
        if (tree.exposed[static_cast<std::size_t>(l.receiver)] <= 0 ||
            tree.exposed[static_cast<std::size_t>(l.source)] <= 0)
            l.form_factor = 0;
    }
}

// Returns the number of rays.
std::size_t test_links(const Scene& scene, const Options& options, const ModelReuse& reuse,
                       RefinedLinks& links, Model& model, Progress& progress) {
    const auto test = [&](const EarlierPairs* earlier) {
        return apply_ray_visibility(model.tree, model.rays, visibility_rays(options), links.pairs,
                                    links.links, progress,
                                    {earlier, reuse.keep ? &model.tested : nullptr});
    };
    if (!reuse.model) return test(nullptr);
    const SceneChange change(*reuse.scene, reuse.model->tree, scene, model.tree);
    const EarlierPairs earlier{change, reuse.model->tested};
    return test(&earlier);
}

}  // namespace

bool needs_directions(const Options& options) {
    const DisplayOptions display = options.resolved_display();
    return options.visibility != Visibility::kExplicit ||
           (display.mode == DisplayMode::kFinalShooting &&
            display.shooting_visibility == ShootingVisibility::kAntiradiance);
}

VisibilityRays visibility_rays(const Options& options) {
    return {.per_pair = options.visibility_rays,
            .graded = true,
            .emitters_shine = options.direct_light == DirectLightMode::kImplicit};
}

Model build_model(const Scene& scene, const Options& options, Progress& progress, float coarseness,
                  const ModelReuse& reuse) {
    Stopwatch watch;
    progress.begin_stage("Building the patch hierarchy", 0.02F, 0.1F);
    Model model{RayScene(scene)};
    model.planes = BlockingPlanes(scene.blockers, model.rays.epsilon());
    model.cuts.per_plane.resize(scene.blockers.size());
    std::vector<Surface> surfaces = lit_surfaces(scene, model.rays, options, progress);
    if (surfaces.empty()) {
        model.tree.triangle_surface.assign(scene.triangles.size(), {kNone, kNone});
        model.hierarchy_seconds = watch.lap();
        return model;
    }
    const float patch_size =
        coarseness *
        (options.max_patch_size > 0 ? options.max_patch_size : automatic_patch_size(surfaces));
    check_memory(scene, surfaces, patch_size);
    RefineOptions refine = refine_options(options, patch_size, surfaces.size(), coarseness);
    refine.planes = &model.planes;
    GrowingTree growing(std::move(surfaces));
    const std::string burden = check_implicit_links(scene, growing, options, refine);
    growing.split_to(patch_size);
    model.hierarchy_seconds = watch.lap();

    progress.begin_stage(burden.empty() ? "Linking patches" : burden, 0.1F, 0.25F);
    const DirectionBins bins(link_bins(options, refine.cluster_links));
    RefinedLinks refined = refine_links(growing, bins, refine, progress);
    model.links_seconds = watch.lap();

    std::vector<NodeId> number;
    model.tree = growing.finish(scene, number);
    refined.renumber(number);
    model.warnings = find_buried_patches(scene, model.rays, model.tree, progress);
    if (!burden.empty()) model.warnings.push_back(burden);
    drop_buried(model.tree, refined.links);
    model.hierarchy_seconds += watch.lap();

    model.cuts = cut_by_blockers(scene, model.tree, model.rays, model.planes, refined, progress);
    model.warnings.insert(model.warnings.end(), model.cuts.warnings.begin(),
                          model.cuts.warnings.end());
    watch.lap();

    const bool explicit_visibility = options.visibility == Visibility::kExplicit;
    if (explicit_visibility) {
        progress.begin_stage("Testing visibility", 0.25F, 0.4F);
        model.link_rays = test_links(scene, options, reuse, refined, model, progress);
        model.visibility_seconds = watch.lap();
    }

    progress.begin_stage("Sorting links", 0.4F, 0.45F);
    model.links = build_link_set(model.tree, bins, refined.links, progress);
    if (options.visibility == Visibility::kDiscrete) {
        const std::vector<std::uint8_t> gone = all_but_shortest(model.tree, model.links, progress);
        model.links = remove_links(std::move(model.links), gone);
    }
    model.links_seconds += watch.lap();

    if (explicit_visibility) {
        model.row_scale =
            row_scales(model.tree, model.links, {}, model.rays, model.planes, progress);
        model.visibility_seconds += watch.lap();
    } else {
        model.row_scale.assign(model.tree.size(), 1);
    }
    return model;
}

}  // namespace antiradiance
