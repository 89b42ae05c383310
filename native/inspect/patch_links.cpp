// SPDX-License-Identifier: GPL-3.0-or-later
#include "inspect/patch_links.h"

#include <algorithm>
#include <array>

#include "links/visibility.h"

namespace antiradiance {

namespace {

// Rays between two ends. Those with which a render tests a link of average transfer are among them,
// so that it finds no link needless that the render kept.
constexpr int kRays = 16;

constexpr std::array<EnumItem, 3> kKinds{{
    {"NEEDED", "Needed", "Its ends see each other, at least in part"},
    {"OCCLUDED", "Occluded", "Carries light through surfaces, which antiradiance takes back"},
    {"ANTIRADIANCE", "Antiradiance", "Takes back light that went through the patch it comes from"},
}};

// The subtree of a node is a range.
bool is_above(const PatchTree& tree, NodeId node, NodeId leaf) {
    return node <= leaf && leaf < tree.subtree_end[static_cast<std::size_t>(node)];
}

// All links to the leaf; + links count as needed.
std::vector<PatchLink> arriving(const PatchTree& tree, const LinkSet& links, NodeId leaf) {
    std::vector<PatchLink> found;
    for (int b = 0; b < links.bins.count(); ++b) {
        const auto bin = static_cast<std::size_t>(b);
        for (std::uint32_t i = links.bin_segments[bin]; i < links.bin_segments[bin + 1]; ++i) {
            const Segment& s = links.segments[i];
            if (!is_above(tree, s.receiver, leaf)) continue;
            for (std::uint32_t l = s.begin; l < s.end; ++l) {
                const Link& link = links.links[l];
                found.push_back({link.source, s.receiver,
                                 link.form_factor < 0 ? LinkKind::kAntiradiance : LinkKind::kNeeded,
                                 link.form_factor, b});
            }
        }
    }
    return found;
}

void keep_largest(const PatchTree& tree, NodeId leaf, std::size_t most,
                  std::vector<PatchLink>& links) {
    // What ancestors receive reaches the leaf with the same density.
    const auto transfer = [&](const PatchLink& l) {
        return link_transfer(tree, l.source, leaf, l.form_factor);
    };
    std::ranges::stable_sort(links, std::ranges::greater{}, transfer);
    links.resize(std::min(most, links.size()));
}

void find_occluded(const Model& model, std::vector<PatchLink>& links) {
    std::vector<TestedPair> pairs;
    pairs.reserve(links.size());
    for (const PatchLink& l : links)
        pairs.push_back({.a = l.source,
                         .b = l.receiver,
                         .rays = l.kind == LinkKind::kAntiradiance ? 0 : kRays});
    Progress progress;
    const std::vector<float> visible = trace_pairs(model.tree, model.rays, pairs, progress);
    for (std::size_t i = 0; i < links.size(); ++i) {
        if (pairs[i].rays > 0 && visible[i] == 0) links[i].kind = LinkKind::kOccluded;
    }
}

}  // namespace

std::span<const EnumItem> link_kinds() {
    return kKinds;
}

NodeId pick(const SolvedScene& solved, const vec3& origin, const vec3& direction) {
    const Model& model = *solved.model;
    const vec3 unit = glm::normalize(direction);
    const RayHit hit = model.rays.intersect(origin, unit);
    if (!hit.hit()) return kNone;
    return model.tree.lookup(hit.triangle, hit.back_side, origin + unit * hit.distance);
}

PatchLinks links_of(const SolvedScene& solved, NodeId leaf, std::size_t most) {
    PatchLinks result;
    result.links = arriving(solved.model->tree, solved.links(), leaf);
    result.total = result.links.size();
    keep_largest(solved.model->tree, leaf, most, result.links);
    find_occluded(*solved.model, result.links);
    return result;
}

}  // namespace antiradiance
