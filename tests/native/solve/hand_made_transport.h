// SPDX-License-Identifier: GPL-3.0-or-later
// Link meshes of a few links, written down one by one, whose solution can be had by hand.
#pragma once

#include <vector>

#include "solve/solver.h"

namespace antiradiance::test {

// `patch_count` patches of 1 m2 below one cluster; patch i is node i + 1. All links of a bin come
// in one call after another, bins ascending.
class HandMadeTransport {
public:
    explicit HandMadeTransport(int patch_count) {
        add_node(kNone, kNone, static_cast<float>(patch_count));
        tree_.subtree_end[0] = patch_count + 1;
        for (SurfaceId s = 0; s < patch_count; ++s) {
            tree_.surfaces.emplace_back();
            tree_.surface_node.push_back(s + 1);
            tree_.leaves.push_back(s + 1);
            add_node(0, s, 1);
        }
        source.assign(tree_.size(), vec3(0));
        albedo.assign(tree_.size(), vec3(0));
        row_scale_.assign(tree_.size(), 1);
        links_.bins = DirectionBins(32);
        links_.bin_segments.assign(33, 0);
    }

    // phi_per_radiance: sr, pi times the form factor; negative: a - link. C of the receiver's bin
    // in sr.
    struct Incoming {
        NodeId from;
        float phi_per_radiance;
    };
    void add(int bin, NodeId receiver, float c, const std::vector<Incoming>& incoming) {
        const auto begin = static_cast<std::uint32_t>(links_.links.size());
        for (const Incoming& i : incoming) {
            links_.links.push_back({i.from, i.phi_per_radiance * kInvPi});
            ++(i.phi_per_radiance > 0 ? links_.radiance_count : links_.antiradiance_count);
        }
        const auto end = static_cast<std::uint32_t>(links_.links.size());
        links_.segments.push_back({receiver, begin, end, 1 / c});
        for (auto b = static_cast<std::size_t>(bin) + 1; b < links_.bin_segments.size(); ++b)
            links_.bin_segments[b] = static_cast<std::uint32_t>(links_.segments.size());
    }

    [[nodiscard]] TransportProblem problem() const {
        return {tree_, links_, source, albedo, row_scale_};
    }

    std::vector<vec3> source, albedo;  // #nodes

private:
    void add_node(NodeId parent, SurfaceId surface, float area) {
        tree_.parent.push_back(parent);
        tree_.subtree_end.push_back(static_cast<NodeId>(tree_.size()));
        tree_.depth.push_back(parent == kNone ? 0 : 1);
        tree_.surface.push_back(surface);
        tree_.normal.emplace_back(0, 0, 1);
        tree_.center.emplace_back(0);
        tree_.area.push_back(area);
        tree_.cone_cosine.push_back(1);
    }

    PatchTree tree_;
    LinkSet links_;
    std::vector<float> row_scale_;
};

}  // namespace antiradiance::test
