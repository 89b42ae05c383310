// SPDX-License-Identifier: GPL-3.0-or-later
// Direct light of every leaf patch.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "base/random.h"
#include "solve/direct_light.h"
#include "solve/direct_light_estimate.h"

namespace antiradiance {

namespace {

constexpr std::uint32_t kStrata = 16;  // of PatchTree::exposed_mask, 4 x 4
constexpr int kFirstRays = 16;         // for each emitter and leaf, before a look at the error
constexpr int kMostRays = 256;
constexpr int kShadowRays = 64;        // for an emitter that seems to be hidden altogether
constexpr std::size_t kMapPoints = 4;  // of a leaf that shadow maps light
constexpr std::size_t kBlock = 16;     // leaves; a few ms

// One point in every exposed stratum of a leaf; `pass` moves it inside its stratum.
void leaf_points(const PatchTree& tree, NodeId leaf, std::uint32_t pass,
                 std::vector<SurfacePoint>& points) {
    points.clear();
    const auto n = static_cast<std::size_t>(leaf);
    const std::uint32_t mask = tree.exposed_mask.empty() ? 0xffffU : tree.exposed_mask[n];
    const std::uint32_t seed = hash_u32(static_cast<std::uint32_t>(leaf));
    for (std::uint32_t i = 0; i < kStrata; ++i) {
        // Another order each pass, so that a stratum meets every part of a lamp.
        const std::uint32_t stratum = i ^ (hash_combine(seed, pass) % kStrata);
        if ((mask & (1U << stratum)) == 0) continue;
        // Every other pass mirrors the one before it, for gradients to cancel.
        const vec2 place = r2_sample(pass / 2, hash_combine(seed, stratum));
        const vec2 jitter = pass % 2 ? 1.0F - place : place;
        const vec2 cell(static_cast<float>(stratum % 4), static_cast<float>(stratum / 4));
        const vec3 normal = tree.normal[n];
        points.push_back({tree.patch_point(leaf, (cell + jitter) / 4.0F), normal, normal});
    }
}

// shares: sets the part of each light, unless it is empty.
vec3 leaf_mean(const DirectLight::Impl& light, const PatchTree& tree, NodeId leaf, float tolerance,
               std::vector<SurfacePoint>& points, std::span<vec3> shares) {
    leaf_points(tree, leaf, 0, points);
    if (points.empty()) return vec3(0);
    const std::uint32_t seed = hash_combine(0x51ed270bU, static_cast<std::uint32_t>(leaf));
    IrradianceEstimate estimate(light, points, seed);
    std::uint32_t pass = 0;
    for (int rays = 0, wanted = kFirstRays; rays < kMostRays; wanted *= 4) {
        while (rays < std::min(wanted, kMostRays)) {
            leaf_points(tree, leaf, pass++, points);
            estimate.add(points);
            rays += static_cast<int>(points.size());
        }
        if (!estimate.refine(tolerance * luminance(estimate.mean()), kShadowRays)) break;
    }
    if (!shares.empty()) estimate.split(shares);
    return estimate.mean();
}

bool can_be_lit(const PatchTree& tree, NodeId leaf) {
    return !tree.is_cluster(leaf) && !tree.emits_only(leaf);
}

std::vector<vec3> mapped_leaves(const DirectLight& light, const PatchTree& tree,
                                Progress& progress) {
    std::vector<SurfacePoint> points;
    std::vector<std::uint32_t> ends;
    std::vector<SurfacePoint> of_leaf;
    for (const NodeId leaf : tree.leaves) {
        if (can_be_lit(tree, leaf)) {
            leaf_points(tree, leaf, 0, of_leaf);
            const std::vector<SurfacePoint> few = spread_choice(of_leaf, kMapPoints);
            points.insert(points.end(), few.begin(), few.end());
        }
        ends.push_back(static_cast<std::uint32_t>(points.size()));
    }
    const std::vector<vec3> means = light.mapped_irradiance(points, ends, progress, {});
    std::vector<vec3> irradiance(tree.size(), vec3(0));
    for (std::size_t i = 0; i < means.size(); ++i)
        irradiance[static_cast<std::size_t>(tree.leaves[i])] = means[i];
    return irradiance;
}

// Of which leaves light from an earlier state still holds.
class KeptLeaves {
public:
    KeptLeaves(const DirectLight::Impl& light, const PatchTree& tree, const EarlierLight& earlier)
        : tree_(tree), earlier_(earlier) {
        for (const std::int32_t i : light.always) {
            const Emitter& emitter = *light.emitters[static_cast<std::size_t>(i)];
            if (emitter.at_infinity()) {
                const EmitterBounds sky = emitter.bounds();
                skies_.push_back({-sky.axis, std::acos(sky.cos_spread) + kSkyMargin});
            } else {
                lights_.push_back(emitter.box());
            }
        }
        if (light.in_tree.empty()) return;
        const std::vector<std::int32_t> neighbours = light.tree.emitters();
        const std::size_t stretch = (neighbours.size() + kMostBoxes - 1) / kMostBoxes;
        for (std::size_t i = 0; i < neighbours.size(); ++i) {
            if (i % stretch == 0) lights_.emplace_back();
            const std::int32_t emitter = light.in_tree[static_cast<std::size_t>(neighbours[i])];
            lights_.back().add(light.emitters[static_cast<std::size_t>(emitter)]->box());
        }
    }

    // The node of the earlier tree whose light is that of a leaf; kNone: rays have to look.
    [[nodiscard]] NodeId operator()(NodeId leaf) const {
        const NodeId twin = earlier_.change.earlier(leaf);
        if (twin == kNone || !earlier_.tree.is_leaf(twin)) return kNone;
        const Box& box = earlier_.change.box(leaf);
        for (const Box& light : lights_) {
            if (faces(leaf, light) && earlier_.change.may_be_between(box, light)) return kNone;
        }
        for (const Sky& sky : skies_) {
            if (earlier_.change.may_be_before_sky(box, sky.direction, sky.angle)) return kNone;
        }
        return twin;
    }

private:
    // Of more emitters in the tree, neighbours are looked at together.
    static constexpr std::size_t kMostBoxes = 256;
    static constexpr float kSkyMargin = 1e-3F;  // rad: the cosine is a float

    struct Sky {
        vec3 direction;
        float angle;  // rad
    };

    // Whether any of the box lies before the leaf's plane.
    [[nodiscard]] bool faces(NodeId leaf, const Box& box) const {
        const auto n = static_cast<std::size_t>(leaf);
        const vec3 to_farthest =
            glm::mix(box.low, box.high, glm::greaterThan(tree_.normal[n], vec3(0))) -
            tree_.center[n];
        return glm::dot(to_farthest, tree_.normal[n]) > -tree_.radius[n] * 1e-3F;
    }

    const PatchTree& tree_;
    const EarlierLight& earlier_;
    std::vector<Box> lights_;
    std::vector<Sky> skies_;
};

}  // namespace

std::vector<vec3> DirectLight::leaf_irradiance(const PatchTree& tree, Progress& progress,
                                               LightShares* shares, float tolerance,
                                               const EarlierLight* earlier) const {
    std::vector<vec3> irradiance(tree.size(), vec3(0));
    if (shares) *shares = {};
    if (!any()) return irradiance;
    if (has_maps()) return mapped_leaves(*this, tree, progress);
    const bool split = shares != nullptr && impl_->lights.size() <= LightShares::kMostLights;
    if (split) {
        shares->lights = impl_->lights;
        shares->irradiance.assign(impl_->lights.size(), irradiance);
    }
    std::optional<KeptLeaves> kept;
    if (earlier && earlier->shares.lights == (split ? shares->lights : std::vector<LightSource>{}))
        kept.emplace(*impl_, tree, *earlier);
    parallel_for_blocks(
        tree.leaves.size(), kBlock, progress, [&](std::size_t begin, std::size_t end) {
            std::vector<SurfacePoint> points;
            std::vector<vec3> parts(split ? impl_->lights.size() : 0);
            for (std::size_t i = begin; i < end; ++i) {
                progress.check();
                const NodeId leaf = tree.leaves[i];
                if (!can_be_lit(tree, leaf)) continue;
                const auto n = static_cast<std::size_t>(leaf);
                if (const NodeId twin = kept ? (*kept)(leaf) : kNone; twin != kNone) {
                    const auto was = static_cast<std::size_t>(twin);
                    irradiance[n] = earlier->irradiance[was];
                    for (std::size_t light = 0; light < parts.size(); ++light)
                        shares->irradiance[light][n] = earlier->shares.irradiance[light][was];
                    continue;
                }
                irradiance[n] = leaf_mean(*impl_, tree, leaf, tolerance, points, parts);
                for (std::size_t light = 0; light < parts.size(); ++light)
                    shares->irradiance[light][n] = parts[light];
            }
        });
    return irradiance;
}

}  // namespace antiradiance
