// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/random_transport.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace antiradiance::test {
namespace {

class Maker {
public:
    Maker(const RandomTransportOptions& options, RandomTransport& out)
        : o_(options), out_(out), random_(options.seed) {}

    void make() {
        add_clusters(kNone, 0, o_.surfaces);
        for (NodeId n = 0; n < static_cast<NodeId>(out_.tree.size()); ++n) {
            (out_.tree.is_cluster(n) ? clusters_ : patches_).push_back(n);
            if (out_.tree.is_leaf(n)) out_.tree.leaves.push_back(n);
        }
        // One lamp, which no cluster sends for or lights.
        out_.tree.surfaces.back().lamp = 0;
        fill_materials();
        add_links();
    }

private:
    float uniform(float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random_);
    }
    int integer(int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(random_);
    }
    vec3 color(float low, float high) {
        return {uniform(low, high), uniform(low, high), uniform(low, high)};
    }

    NodeId add_node(NodeId parent, SurfaceId surface, const vec3& normal) {
        PatchTree& t = out_.tree;
        const auto node = static_cast<NodeId>(t.size());
        t.parent.push_back(parent);
        t.subtree_end.push_back(0);
        t.depth.push_back(parent == kNone ? 0 : t.depth[static_cast<std::size_t>(parent)] + 1);
        t.surface.push_back(surface);
        t.normal.push_back(normal);
        t.area.push_back(0);
        t.cone_cosine.push_back(uniform(0.7F, 1.0F));
        t.center.emplace_back(0);
        return node;
    }
    void end_node(NodeId node, float area) {
        out_.tree.subtree_end[static_cast<std::size_t>(node)] =
            static_cast<NodeId>(out_.tree.size());
        out_.tree.area[static_cast<std::size_t>(node)] = area;
    }

    float add_clusters(NodeId parent, int first, int count) {
        const NodeId node = add_node(parent, kNone, vec3(0));
        float area = 0;
        if (count <= 2) {
            for (int s = 0; s < count; ++s)
                area += add_surface(node);
        } else {
            const int left = integer(1, count - 1);
            area += add_clusters(node, first, left);
            area += add_clusters(node, first + left, count - left);
        }
        end_node(node, area);
        return area;
    }
    float add_surface(NodeId parent) {
        const auto surface = static_cast<SurfaceId>(out_.tree.surfaces.size());
        out_.tree.surfaces.emplace_back();
        const vec3 normal = glm::normalize(color(-1, 1) + vec3(0, 0, 1e-3F));
        out_.tree.surface_node.push_back(static_cast<NodeId>(out_.tree.size()));
        return add_patch(parent, surface, normal, uniform(0.5F, 2), o_.levels);
    }
    float add_patch(NodeId parent, SurfaceId surface, const vec3& normal, float area, int levels) {
        const NodeId node = add_node(parent, surface, normal);
        if (levels > 0 && integer(0, 3) > 0) {
            for (int k = 0; k < 4; ++k)
                add_patch(node, surface, normal, area / 4, levels - 1);
        }
        end_node(node, area);
        return area;
    }

    void fill_materials() {
        const std::size_t count = out_.tree.size();
        out_.source.assign(count, vec3(7));  // only what leaves have counts
        out_.albedo.assign(count, vec3(7));
        out_.row_scale.assign(count, 7);
        for (const NodeId leaf : out_.tree.leaves) {
            const auto n = static_cast<std::size_t>(leaf);
            out_.source[n] = integer(0, 3) == 0 ? color(0, 5) : vec3(0);
            out_.albedo[n] = color(0.1F, 0.9F);
            out_.row_scale[n] = uniform(0.8F, 1.2F);
        }
    }

    NodeId end_of_link() {
        const bool cluster = uniform(0, 1) < o_.cluster_share;
        const std::vector<NodeId>& from = cluster ? clusters_ : patches_;
        return from[static_cast<std::size_t>(integer(0, static_cast<int>(from.size()) - 1))];
    }
    void add_links() {
        LinkSet& set = out_.links;
        set.bins = DirectionBins(o_.bins);
        set.bin_segments.push_back(0);
        const float links =
            static_cast<float>(o_.links_per_segment * o_.segments_per_bin * o_.bins) /
            static_cast<float>(patches_.size());
        for (int b = 0; b < o_.bins; ++b) {
            std::set<NodeId> receivers;  // one segment each
            while (static_cast<int>(receivers.size()) <
                   std::min<int>(o_.segments_per_bin, static_cast<int>(out_.tree.size()) / 2)) {
                receivers.insert(end_of_link());
            }
            int long_left = o_.long_segments;
            for (const NodeId r : receivers) {
                const int mean = o_.links_per_segment * (long_left-- > 0 ? 20 : 1);
                add_segment(r, integer(1, 2 * mean), 2 * o_.gain / links);
            }
            set.bin_segments.push_back(static_cast<std::uint32_t>(set.segments.size()));
        }
    }
    void add_segment(NodeId receiver, int count, float most) {
        LinkSet& set = out_.links;
        const auto begin = static_cast<std::uint32_t>(set.links.size());
        for (int i = 0; i < count; ++i) {
            const NodeId source = end_of_link();
            const bool minus =
                !out_.tree.is_cluster(source) && uniform(0, 1) < o_.antiradiance_share;
            set.links.push_back({source, uniform(0, most) * (minus ? -1.0F : 1.0F)});
            ++(minus ? set.antiradiance_count : set.radiance_count);
        }
        float sum = 0;
        for (std::size_t l = begin; l < set.links.size(); ++l) {
            sum += std::abs(set.links[l].form_factor);
        }
        const float inv_c =
            out_.tree.is_cluster(receiver) ? 0 : o_.gain * uniform(0.5F, 1.5F) / (kPi * sum);
        set.segments.push_back(
            {receiver, begin, static_cast<std::uint32_t>(set.links.size()), inv_c});
    }

    const RandomTransportOptions& o_;
    RandomTransport& out_;
    std::mt19937 random_;
    std::vector<NodeId> clusters_, patches_;
};

}  // namespace

RandomTransport::RandomTransport(const RandomTransportOptions& options) {
    Maker(options, *this).make();
}

}  // namespace antiradiance::test
