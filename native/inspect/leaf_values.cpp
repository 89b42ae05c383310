// SPDX-License-Identifier: GPL-3.0-or-later
#include "inspect/leaf_values.h"

#include <algorithm>
#include <stdexcept>

#include "base/parallel.h"
#include "base/random.h"
#include "links/visibility.h"
#include "solve/transport.h"

namespace antiradiance {

namespace {

// A sweep front to back solves A where occlusion has no cycles. Of those that do, rooms settle the
// last after some ten.
constexpr int kMostSweeps = 32;
constexpr float kSettled = 1e-5F;      // change of Phi by a sweep, relative to the largest
constexpr std::uint32_t kPoints = 16;  // of a leaf, where two solutions are compared
constexpr std::size_t kBlock = 256;

bool is_settled(std::span<const vec3> before, std::span<const vec3> after) {
    float change = 0;
    float largest = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        change = std::max(change, max_component(glm::abs(after[i] - before[i])));
        largest = std::max(largest, max_component(glm::abs(after[i])));
    }
    return change <= kSettled * largest;
}

// Phi with the antiradiance that belongs to the solution's radiance.
void settle(const LinkSet& links, std::span<const vec3> radiance, Transport& transport,
            Progress& progress) {
    std::vector<vec3> before;
    for (int i = 0; i < kMostSweeps; ++i) {
        before.assign(transport.flux().begin(), transport.flux().end());
        transport.gather(radiance, Sweep::kFrontToBack, 1, progress);
        if (links.antiradiance_count == 0 || is_settled(before, transport.flux())) break;
    }
}

std::vector<vec3> gather(const SolvedScene& solved, const LinkSet& links, Progress& progress) {
    const PatchTree& tree = solved.model->tree;
    Transport transport(tree, links);
    settle(links, solved.light->radiance, transport, progress);
    std::vector<vec3> irradiance = transport.leaf_irradiance();
    const std::span<const float> row_scale = solved.problem().row_scale;
    for (const NodeId leaf : tree.leaves)
        irradiance[static_cast<std::size_t>(leaf)] *= row_scale[static_cast<std::size_t>(leaf)];
    return irradiance;
}

// The links of one bin, which need no others: antiradiance stays in its bin.
LinkSet links_of_bin(const LinkSet& all, int bin) {
    const auto b = static_cast<std::size_t>(bin);
    const std::span<const Segment> segments(all.segments.data() + all.bin_segments[b],
                                            all.segments.data() + all.bin_segments[b + 1]);
    LinkSet one;
    one.bins = all.bins;
    for (const Segment& s : segments) {
        const auto begin = static_cast<std::uint32_t>(one.links.size());
        one.links.insert(one.links.end(), all.links.begin() + s.begin, all.links.begin() + s.end);
        one.segments.push_back(
            {s.receiver, begin, static_cast<std::uint32_t>(one.links.size()), s.inv_c});
    }
    one.bin_segments.assign(all.bin_segments.size(), 0);
    std::fill(one.bin_segments.begin() + bin + 1, one.bin_segments.end(),
              static_cast<std::uint32_t>(one.segments.size()));
    one.radiance_count = static_cast<std::size_t>(
        std::ranges::count_if(one.links, [](const Link& l) { return l.form_factor > 0; }));
    one.antiradiance_count = one.links.size() - one.radiance_count;
    return one;
}

// Not a lamp, and not buried.
bool receives(const PatchTree& tree, NodeId leaf) {
    return !tree.emits_only(leaf) && tree.exposed[static_cast<std::size_t>(leaf)] > 0;
}

// Luminance of direct and indirect light over what is exposed of all surfaces, W/m2.
double mean_irradiance(const SolvedScene& solved) {
    const PatchTree& tree = solved.model->tree;
    double sum = 0;
    double area = 0;
    for (const NodeId leaf : tree.leaves) {
        if (!receives(tree, leaf)) continue;
        const auto n = static_cast<std::size_t>(leaf);
        const double exposed = static_cast<double>(tree.area[n]) * tree.exposed[n];
        sum += exposed * luminance((*solved.leaf_direct)[n] + solved.light->irradiance[n]);
        area += exposed;
    }
    return area > 0 ? sum / area : 0;
}

}  // namespace

NodeId ancestor(const PatchTree& tree, NodeId node, int level) {
    for (; level > 0; --level) {
        const NodeId parent = tree.parent[static_cast<std::size_t>(node)];
        if (parent == kNone) break;
        node = parent;
    }
    return node;
}

int level_count(const PatchTree& tree) {
    return tree.depth.empty() ? 0 : 1 + std::ranges::max(tree.depth);
}

std::vector<vec3> regathered_irradiance(const SolvedScene& solved, Progress& progress) {
    if (solved.model->tree.size() == 0) return {};
    return gather(solved, solved.links(), progress);
}

std::vector<vec3> bin_irradiance(const SolvedScene& solved, int bin, Progress& progress) {
    if (solved.model->tree.size() == 0) return {};
    const LinkSet& links = solved.links();
    return gather(solved, links_of_bin(links, std::clamp(bin, 0, links.bins.count() - 1)),
                  progress);
}

std::vector<float> residuals(const SolvedScene& solved, Progress& progress) {
    const PatchTree& tree = solved.model->tree;
    const TransportProblem problem = solved.problem();
    const std::vector<vec3> irradiance = regathered_irradiance(solved, progress);
    std::vector<float> change(tree.size(), 0);
    float largest = 0;
    for (const NodeId leaf : tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        const vec3& was = solved.light->radiance[n];
        const vec3 is =
            glm::max(vec3(0), problem.source[n] + problem.albedo[n] * kInvPi * irradiance[n]);
        change[n] = max_component(glm::abs(is - was));
        largest = std::max(largest, max_component(was));
    }
    if (largest > 0) {
        for (float& c : change)
            c /= largest;
    }
    return change;
}

std::vector<float> irradiance_differences(const SolvedScene& solved, const SolvedScene& truth,
                                          Progress& progress) {
    const PatchTree& tree = solved.model->tree;
    const PatchTree& other = truth.model->tree;
    if (tree.triangle_surface.size() != other.triangle_surface.size())
        throw std::invalid_argument("two solutions of different scenes can't be compared");
    std::vector<float> difference(tree.size(), 0);
    const double mean = mean_irradiance(truth);
    if (mean <= 0) return difference;
    const SurfaceSampler sampler(tree);
    const auto compare = [&](NodeId leaf) {
        const auto n = static_cast<std::size_t>(leaf);
        const Surface& surface = tree.surfaces[static_cast<std::size_t>(tree.surface[n])];
        const std::uint32_t seed = hash_u32(static_cast<std::uint32_t>(leaf));
        double sum = 0;
        for (std::uint32_t i = 0; i < kPoints; ++i) {
            const NodeId there = other.lookup(surface.triangles[0], surface.back_side,
                                              sampler.sample(leaf, r2_sample(i, seed)).point);
            vec3 d = solved.light->irradiance[n];
            if (there != kNone) d -= truth.light->irradiance[static_cast<std::size_t>(there)];
            sum += luminance(d);
        }
        difference[n] = static_cast<float>(sum / (kPoints * mean));
    };
    parallel_for_blocks(tree.leaves.size(), kBlock, progress,
                        [&](std::size_t begin, std::size_t end) {
                            for (std::size_t i = begin; i < end; ++i) {
                                if (receives(tree, tree.leaves[i])) compare(tree.leaves[i]);
                            }
                        });
    return difference;
}

}  // namespace antiradiance
