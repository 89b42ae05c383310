// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/display.h"

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "display/bin_weights.h"
#include "display/fragment_groups.h"
#include "display/gbuffer.h"
#include "display/interleave.h"
#include "display/patch_lights.h"
#include "display/shared_receivers.h"
#include "display/shooting.h"
#include "display/source_lists.h"
#include "solve/antiradiance_table.h"

namespace antiradiance {

namespace {

// The part of the display's progress that the G-buffer and direct light take.
constexpr float kGBufferShare = 0.5F;
constexpr ProgressSpan kIndirectSpan{kGBufferShare, 1};

constexpr int kTileSize = 8;  // pixels along a side of what shares a list of sources

// Indirect irradiance of every fragment, W/m2.
using IndirectLight = std::vector<vec3> (*)(const DisplayInput&, const DisplayOptions&,
                                            const GBuffer&, DisplayBackend&, Progress&);

// "No interpolation" in the paper's Fig. 9.
std::vector<vec3> patch_irradiance(const DisplayInput& input, const DisplayOptions&,
                                   const GBuffer& buffer, DisplayBackend&, Progress&) {
    std::vector<vec3> irradiance(buffer.fragments.size(), vec3(0));
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const NodeId leaf = buffer.fragments[i].leaf;
        if (leaf != kNone) irradiance[i] = input.irradiance[static_cast<std::size_t>(leaf)];
    }
    return irradiance;
}

vec3 eye_of(const Camera& camera) {
    return vec3(camera.to_world[3]);
}

std::vector<vec3> splatted_irradiance(const DisplayInput& input, const DisplayOptions&,
                                      const GBuffer& buffer, DisplayBackend& backend,
                                      Progress& progress) {
    const FragmentGroups tiles = tile_groups(buffer, eye_of(input.camera), kTileSize);
    const SourceLists disks = find_disks(input.tree, tiles, progress);
    return backend.splat({input.tree, input.irradiance, buffer, tiles, disks}, progress,
                         kIndirectSpan);
}

// Direct and indirect light of the leaves, W/m2.
std::vector<vec3> total_irradiance(const DisplayInput& input) {
    std::vector<vec3> sum(input.irradiance.begin(), input.irradiance.end());
    for (std::size_t n = 0; n < sum.size(); ++n)
        sum[n] += input.leaf_direct[n];
    return sum;
}

// Whether what lights a fragment depends on the leaf that it lies on.
bool lit_by_leaf(const DisplayInput& input) {
    return input.linked != nullptr || !input.planes.empty();
}

// Before blocking planes cut any.
SourceLists find_all_sources(const DisplayInput& input, const DisplayOptions& options,
                             const GBuffer& buffer, const FragmentGroups& groups,
                             Progress& progress) {
    const ShootingLevel level = options.shooting_level;
    CutRule rule;
    rule.fronts_only = options.shooting_visibility == ShootingVisibility::kRays;
    if (input.linked)
        return linked_sources(input.tree, *input.linked, buffer, groups, level, rule, progress);
    if (level == ShootingLevel::kCut) return cut_sources(input.tree, groups, rule, progress);
    return all_sources(input.tree, level, groups.groups.size());
}

SourceLists find_sources(const DisplayInput& input, const DisplayOptions& options,
                         const GBuffer& buffer, const FragmentGroups& groups, Progress& progress) {
    SourceLists all = find_all_sources(input, options, buffer, groups, progress);
    if (input.planes.empty()) return all;
    return uncut_sources(input.tree, input.planes, buffer, groups, all, progress);
}

// Irradiance of the fragments by the sources of their groups' lists, interleaved over n x n pixels.
using Shoot =
    std::function<std::vector<vec3>(const SourceLists& sources, int n, ProgressSpan span)>;

// n > 1: what is near lights every pixel, and is not blurred. Where all groups share one list, as
// in the paper, all of it is interleaved: lists of their own would not fit into memory.
std::vector<vec3> shoot_interleaved(const DisplayInput& input, const GBuffer& buffer,
                                    const FragmentGroups& groups, const SourceLists& sources, int n,
                                    const Shoot& shoot, Progress& progress) {
    if (n == 1) return shoot(sources, 1, kIndirectSpan);
    if (sources.shared)
        return interleave_blur(buffer, shoot(sources, n, kIndirectSpan), n, progress);
    constexpr float kNearShare = 0.5F;  // of the time
    constexpr float kMiddle = kIndirectSpan.begin + kNearShare * (1 - kIndirectSpan.begin);
    const NearAndFar lists = split_near(input.tree, groups, sources, progress);
    std::vector<vec3> irradiance = shoot(lists.near, 1, {kIndirectSpan.begin, kMiddle});
    const std::vector<vec3> far =
        interleave_blur(buffer, shoot(lists.far, n, {kMiddle, 1}), n, progress);
    for (std::size_t i = 0; i < irradiance.size(); ++i)
        irradiance[i] += far[i];
    return irradiance;
}

std::vector<vec3> shoot_at(const DisplayInput& input, const DisplayOptions& options,
                           const GBuffer& buffer, DisplayBackend& backend, Progress& progress) {
    const FragmentGroups groups =
        lit_by_leaf(input)
            ? receiver_groups(buffer)
            : tile_groups(buffer, eye_of(input.camera), std::max(kTileSize, options.interleave));
    const SourceLists all = find_sources(input, options, buffer, groups, progress);
    const PatchLights lights(input.tree, input.radiance, options.shooting_samples);
    const std::vector<vec3> leaf_light = total_irradiance(input);
    const auto interleaved = [&](const Shoot& shoot) {
        return shoot_interleaved(input, buffer, groups, all, options.interleave, shoot, progress);
    };
    if (options.shooting_visibility == ShootingVisibility::kRays) {
        const std::vector<Moments> clusters = pull_moments(input.tree, input.radiance);
        const auto make = [&] {
            return make_ray_shooter(input.tree, lights, clusters, input.rays);
        };
        return interleaved([&](const SourceLists& sources, int n, ProgressSpan span) {
            return shoot({input.tree, buffer, groups, sources, leaf_light, n}, make, progress,
                         span);
        });
    }
    const AntiradianceTable table =
        antiradiance_table(input.tree, input.links, input.radiance, progress);
    const BinWeights bins(input.links.bins, options.bin_map_size);
    return interleaved([&](const SourceLists& sources, int n, ProgressSpan span) {
        return backend.shoot({{input.tree, buffer, groups, sources, leaf_light, n},
                              lights,
                              table,
                              bins,
                              2 * input.rays.epsilon()},
                             progress, span);
    });
}

std::vector<vec3> shot_irradiance(const DisplayInput& input, const DisplayOptions& options,
                                  const GBuffer& buffer, DisplayBackend& backend,
                                  Progress& progress) {
    if (lit_by_leaf(input)) return shoot_at(input, options, buffer, backend, progress);
    const SharedReceivers shared = share_receivers(input.tree, buffer);
    return shared.spread(shoot_at(input, options, shared.receivers, backend, progress));
}

// Whether a mode has sums for a back end.
using UsesBackend = bool (*)(const DisplayOptions&);

bool always(const DisplayOptions&) {
    return true;
}

bool never(const DisplayOptions&) {
    return false;
}

// Shadow rays stay on the CPU.
bool without_rays(const DisplayOptions& options) {
    return options.shooting_visibility == ShootingVisibility::kAntiradiance;
}

struct Mode {
    DisplayMode mode;
    IndirectLight indirect;
    UsesBackend uses_backend;
    bool by_leaf;  // shows the leaves apart
};
constexpr Mode kModes[] = {
    {DisplayMode::kPatches, &patch_irradiance, &never, true},
    {DisplayMode::kSplatting, &splatted_irradiance, &always, false},
    {DisplayMode::kFinalShooting, &shot_irradiance, &without_rays, false},
};

const Mode& find_mode(DisplayMode mode) {
    for (const Mode& m : kModes) {
        if (m.mode == mode) return m;
    }
    throw std::logic_error("a display mode without a row in kModes");
}

// direct: what lights the pixels beside the mode's light; null: nothing.
Picture compose(const DisplayInput& input, const DirectLight* direct, const DisplayOptions& options,
                DisplayBackend& backend, Progress& progress) {
    const Mode& mode = find_mode(options.mode);
    // Links are cut for each leaf by itself.
    const bool by_leaf = mode.by_leaf || lit_by_leaf(input);
    GBuffer buffer =
        make_gbuffer({input.scene, input.camera, input.rays, input.tree, direct, input.leaf_direct,
                      input.irradiance, by_leaf, input.film_transparent, input.samples_per_axis,
                      options.direct_samples},
                     progress, {0, kGBufferShare});
    std::vector<vec3> indirect(buffer.fragments.size(), vec3(0));
    if (input.tree.size() > 0) indirect = mode.indirect(input, options, buffer, backend, progress);
    Picture picture;
    picture.width = buffer.width;
    picture.height = buffer.height;
    picture.combined = std::move(buffer.background);
    picture.depth = std::move(buffer.depth);
    picture.normal = std::move(buffer.normal);
    for (std::size_t i = 0; i < buffer.fragments.size(); ++i) {
        const Fragment& f = buffer.fragments[i];
        const vec3 radiance = f.light + f.albedo * kInvPi * glm::max(indirect[i], vec3(0));
        picture.combined[f.pixel] += f.coverage * vec4(radiance, 1);
    }
    progress.report(1);
    return picture;
}

}  // namespace

bool uses_backend(const DisplayOptions& options) {
    return find_mode(options.mode).uses_backend(options);
}

Picture make_picture(const DisplayInput& input, const DisplayOptions& options,
                     DisplayBackend& backend, Progress& progress) {
    if (input.direct_of_leaves) {
        const std::vector<vec3> all_light = total_irradiance(input);
        DisplayInput indirect = input;
        indirect.irradiance = all_light;
        return compose(indirect, nullptr, options, backend, progress);
    }
    return compose(input, &input.direct, options, backend, progress);
}

}  // namespace antiradiance
