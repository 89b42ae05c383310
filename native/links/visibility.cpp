// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/visibility.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "base/random.h"
#include "links/tested_pairs.h"

namespace antiradiance {

namespace {

constexpr std::size_t kBlock = 1024;  // pairs; some ms of rays
constexpr int kFacingTries = 4;       // to find members of two clusters that face each other

// Share of segments between two nodes that are free; only those between points that face each
// other count, as the form factor has no part of the others.
class PairVisibility {
public:
    PairVisibility(const PatchTree& tree, const RayScene& rays) : sampler_(tree), rays_(rays) {}

    [[nodiscard]] float operator()(const TestedPair& pair) const {
        // Whoever asks, for one way or the other, gets the same answer.
        const auto [a, b] = std::minmax(pair.a, pair.b);
        const auto count = static_cast<std::uint32_t>(pair.rays);
        const std::uint32_t seed =
            hash_combine(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
        std::uint32_t facing = 0;
        std::uint32_t free = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            for (std::uint32_t attempt = 0; attempt < kFacingTries; ++attempt) {
                const std::uint32_t index = i + attempt * count;
                const auto p = sampler_.sample(a, r2_sample(index, seed));
                const auto q = sampler_.sample(b, r2_sample(index, seed ^ 0x5bd1e995U));
                const vec3 d = q.point - p.point;
                if (glm::dot(d, p.normal) <= 0 || glm::dot(d, q.normal) >= 0) continue;
                ++facing;
                const float offset = 2 * rays_.epsilon();
                if (!rays_.occluded(p.point + p.normal * offset, q.point + q.normal * offset))
                    ++free;
                break;
            }
        }
        return facing ? static_cast<float>(free) / static_cast<float>(facing) : 0.0F;
    }

private:
    SurfaceSampler sampler_;
    const RayScene& rays_;
};

// Shares of the mean transfer that part the grades, and rays of each grade.
constexpr double kFewBelow = 0.5;
constexpr double kManyAbove = 4;
constexpr double kFewRays = 0.25;
constexpr double kManyRays = 2.25;
constexpr double kEmitterRays = 4;

bool emits(const PatchTree& tree, NodeId node) {
    const SurfaceId s = tree.surface[static_cast<std::size_t>(node)];
    return s != kNone && tree.surfaces[static_cast<std::size_t>(s)].emits;
}

// As trace_pairs(); rays: of all pairs, set to those that were traced.
std::vector<float> trace_unknown_pairs(const PatchTree& tree, const RayScene& scene,
                                       std::span<const TestedPair> pairs,
                                       const EarlierPairs& earlier, std::size_t& rays,
                                       Progress& progress) {
    std::vector<std::optional<float>> known(pairs.size());
    parallel_for_blocks(pairs.size(), kBlock, progress, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            known[i] = earlier.find(pairs[i]);
    });
    std::vector<TestedPair> unknown;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (!known[i]) unknown.push_back(pairs[i]);
    }
    const std::vector<float> traced = trace_pairs(tree, scene, unknown, progress);
    std::vector<float> shares(pairs.size());
    auto next = traced.begin();
    rays = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (!known[i]) rays += static_cast<std::size_t>(pairs[i].rays);
        shares[i] = known[i] ? *known[i] : *next++;
    }
    return shares;
}

}  // namespace

SurfaceSampler::SurfaceSampler(const PatchTree& tree, std::span<const float> weight) : tree_(tree) {
    first_leaf_.resize(tree.size() + 1);
    area_.push_back(0);
    for (std::size_t n = 0; n < tree.size(); ++n) {
        first_leaf_[n] = static_cast<std::int32_t>(area_.size() - 1);
        if (!tree.is_leaf(static_cast<NodeId>(n))) continue;
        const double exposed = static_cast<double>(tree.area[n]) * tree.exposed[n];
        area_.push_back(area_.back() + exposed * (weight.empty() ? 1 : weight[n]));
    }
    first_leaf_[tree.size()] = static_cast<std::int32_t>(area_.size() - 1);
}

SurfaceSampler::Sample SurfaceSampler::sample(NodeId node, const vec2& u) const {
    const auto n = static_cast<std::size_t>(node);
    if (!tree_.is_cluster(node) && tree_.exposed[n] >= 1)
        return {tree_.patch_point(node, u), tree_.normal[n]};
    const auto begin = static_cast<std::size_t>(first_leaf_[n]);
    const auto end =
        static_cast<std::size_t>(first_leaf_[static_cast<std::size_t>(tree_.subtree_end[n])]);
    const double at = area_[begin] + (area_[end] - area_[begin]) * static_cast<double>(u.x);
    const auto upper = std::upper_bound(area_.begin() + static_cast<std::ptrdiff_t>(begin + 1),
                                        area_.begin() + static_cast<std::ptrdiff_t>(end), at);
    const auto k = static_cast<std::size_t>(upper - area_.begin()) - 1;
    const NodeId leaf = tree_.leaves[k];
    const double width = area_[k + 1] - area_[k];
    const float rest = width > 0 ? static_cast<float>((at - area_[k]) / width) : 0.5F;
    return {exposed_point(leaf, {std::clamp(rest, 0.0F, 0x1.fffffep-1F), u.y}),
            tree_.normal[static_cast<std::size_t>(leaf)]};
}

vec3 SurfaceSampler::exposed_point(NodeId leaf, const vec2& u) const {
    const std::uint16_t mask = tree_.exposed_mask[static_cast<std::size_t>(leaf)];
    const int exposed = std::popcount(mask);
    if (exposed == 16 || exposed == 0) return tree_.patch_point(leaf, u);
    // u.x picks one of the exposed strata, what is left of it the place inside.
    const float scaled = u.x * static_cast<float>(exposed);
    int skip = std::min(static_cast<int>(scaled), exposed - 1);
    int stratum = 0;
    for (; stratum < 16; ++stratum) {
        if ((mask >> static_cast<unsigned>(stratum) & 1U) && skip-- == 0) break;
    }
    const vec2 cell(static_cast<float>(stratum % 4), static_cast<float>(stratum / 4));
    const vec2 inside(scaled - std::floor(scaled), u.y);
    return tree_.patch_point(leaf, (cell + inside) * 0.25F);
}

double link_transfer(const PatchTree& tree, NodeId source, NodeId receiver, float form_factor) {
    constexpr double kSeen = 0.25;
    const auto area = [&](NodeId n) {
        return static_cast<double>(tree.area[static_cast<std::size_t>(n)]) *
               (tree.is_cluster(n) ? kSeen : 1.0);
    };
    // A cluster's intensity stands for its area as well; see Link.
    const double sent = tree.is_cluster(source) ? area(source) : 1.0;
    return std::abs(static_cast<double>(form_factor)) * sent * area(receiver);
}

std::size_t count_rays(const PatchTree& tree, const VisibilityRays& rays,
                       std::span<TestedPair> pairs) {
    double sum = 0;
    std::size_t carrying = 0;
    for (const TestedPair& p : pairs) {
        sum += p.transfer;
        if (p.transfer > 0) ++carrying;
    }
    const double mean = carrying ? sum / static_cast<double>(carrying) : 0.0;
    const auto grade = [&](const TestedPair& p) {
        if (!rays.graded) return 1.0;
        if (rays.emitters_shine && (emits(tree, p.a) || emits(tree, p.b))) return kEmitterRays;
        return p.transfer < kFewBelow * mean    ? kFewRays
               : p.transfer < kManyAbove * mean ? 1.0
                                                : kManyRays;
    };
    std::size_t total = 0;
    for (TestedPair& p : pairs) {
        p.rays = p.transfer > 0 ? std::max(1, static_cast<int>(grade(p) * rays.per_pair + 0.5)) : 0;
        total += static_cast<std::size_t>(p.rays);
    }
    return total;
}

std::vector<float> trace_pairs(const PatchTree& tree, const RayScene& scene,
                               std::span<const TestedPair> pairs, Progress& progress) {
    const PairVisibility visibility(tree, scene);
    std::vector<float> shares(pairs.size());
    parallel_for_blocks(pairs.size(), kBlock, progress, [&](std::size_t begin, std::size_t end) {
        std::transform(pairs.begin() + static_cast<std::ptrdiff_t>(begin),
                       pairs.begin() + static_cast<std::ptrdiff_t>(end),
                       shares.begin() + static_cast<std::ptrdiff_t>(begin), visibility);
        progress.check();
    });
    return shares;
}

bool centers_see(const PatchTree& tree, const RayScene& scene, NodeId a, NodeId b) {
    const auto lifted = [&](NodeId n) {
        const auto i = static_cast<std::size_t>(n);
        return tree.center[i] + tree.normal[i] * (2 * scene.epsilon());
    };
    return !scene.occluded(lifted(a), lifted(b));
}

std::size_t apply_ray_visibility(const PatchTree& tree, const RayScene& scene,
                                 const VisibilityRays& rays, std::span<const LinkedPair> pairs,
                                 std::span<RawLink> links, Progress& progress,
                                 const KeptPairs& kept) {
    std::vector<TestedPair> tested(pairs.size());
    parallel_for_blocks(pairs.size(), kBlock, progress, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const LinkedPair& p = pairs[i];
            double to_a = 0;
            double to_b = 0;
            for (const RawLink& l : links.subspan(p.first, p.count))
                (l.receiver == p.a ? to_a : to_b) +=
                    link_transfer(tree, l.source, l.receiver, l.form_factor);
            tested[i] = {p.a, p.b, std::max(to_a, to_b)};
        }
    });
    std::size_t count = count_rays(tree, rays, tested);
    const std::vector<float> visibility =
        kept.earlier ? trace_unknown_pairs(tree, scene, tested, *kept.earlier, count, progress)
                     : trace_pairs(tree, scene, tested, progress);
    if (kept.now) *kept.now = TestedPairs(tree.size(), tested, visibility, progress);
    parallel_for_blocks(pairs.size(), kBlock, progress, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            for (RawLink& l : links.subspan(pairs[i].first, pairs[i].count))
                l.form_factor *= visibility[i];
        }
    });
    return count;
}

}  // namespace antiradiance
