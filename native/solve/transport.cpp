// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/transport.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>

#include "base/parallel.h"

namespace antiradiance {

namespace {

Float4 to_float4(const vec3& v) {
    return Float4{v.x, v.y, v.z, 0};
}
vec3 to_vec3(const Float4& v) {
    return {v[0], v[1], v[2]};
}
Float4 clamp(const Float4& v, const Float4& high) {
    const Float4 zero{};
    const Float4 low = v > zero ? v : zero;
    return low < high ? low : high;
}

}  // namespace

// One thread's memory.
struct Transport::Scratch {
    // What links read: radiance of all nodes, then clamped antiradiance of all nodes in this bin,
    // so that the sign of a link is an offset and the inner loop has no branch.       // 2 #nodes
    std::vector<Float4> sent;
    std::vector<Float4> antiradiance;  // #nodes, unclamped
};

Transport::Transport(const PatchTree& tree, const LinkSet& links)
    : tree_(tree),
      links_(links),
      radiance_(tree.size()),
      phi_(links.segments.size(), Float4{}),
      node_segments_(links.segments.size()),
      node_segment_begin_(tree.size() + 1, 0),
      segment_bin_(links.segments.size()),
      bin_clusters_(static_cast<std::size_t>(links.bins.count())) {
    for (const Segment& s : links.segments)
        ++node_segment_begin_[static_cast<std::size_t>(s.receiver) + 1];
    for (std::size_t n = 0; n < tree.size(); ++n)
        node_segment_begin_[n + 1] += node_segment_begin_[n];
    std::vector<std::uint32_t> fill(node_segment_begin_.begin(), node_segment_begin_.end() - 1);
    std::vector<std::int32_t> last_bin(tree.size(), -1);
    for (int b = 0; b < links.bins.count(); ++b) {
        for (std::uint32_t i = links.bin_segments[static_cast<std::size_t>(b)];
             i < links.bin_segments[static_cast<std::size_t>(b) + 1]; ++i) {
            const Segment& s = links.segments[i];
            segment_bin_[i] = b;
            node_segments_[fill[static_cast<std::size_t>(s.receiver)]++] = i;
            clusters_receive_ = clusters_receive_ || tree.is_cluster(s.receiver);
            for (std::uint32_t l = s.begin; l < s.end; ++l) {
                const NodeId source = links.links[l].source;
                if (!tree.is_cluster(source) || last_bin[static_cast<std::size_t>(source)] == b)
                    continue;
                last_bin[static_cast<std::size_t>(source)] = b;
                bin_clusters_[static_cast<std::size_t>(b)].push_back(source);
                clusters_send_ = true;
            }
        }
    }
}

void Transport::gather(std::span<const vec3> radiance, Sweep sweep, float damping,
                       Progress& progress) {
    most_antiradiance_ = Float4{};
    for (std::size_t n = 0; n < radiance.size(); ++n) {
        radiance_[n] = to_float4(radiance[n]);
        if (!tree_.is_cluster(static_cast<NodeId>(n)))
            most_antiradiance_ =
                radiance_[n] > most_antiradiance_ ? radiance_[n] : most_antiradiance_;
    }
    if (clusters_send_) pull_moments(radiance);
    tbb::enumerable_thread_specific<Scratch> scratch;
    parallel_for(static_cast<std::size_t>(links_.bins.count()), progress, [&](std::size_t bin) {
        Scratch& mine = scratch.local();
        if (mine.sent.empty()) {
            mine.sent = radiance_;
            if (links_.antiradiance_count > 0) {
                mine.sent.resize(2 * radiance_.size());
                mine.antiradiance.resize(radiance_.size());
            }
        }
        gather_bin(static_cast<int>(bin), sweep, damping, mine);
    });
}

void Transport::gather_bin(int bin, Sweep sweep, float damping, Scratch& scratch) {
    const auto b = static_cast<std::size_t>(bin);
    const bool has_antiradiance = links_.antiradiance_count > 0;
    if (has_antiradiance) load_antiradiance(bin, scratch);
    const vec3 axis = links_.bins.axis(bin);
    for (const NodeId c : bin_clusters_[b]) {
        const auto n = static_cast<std::size_t>(c);
        const Moments& sent = sent_[n];
        scratch.sent[n] = to_float4(tree_.cone_cosine[n] > kNarrowCone ? sent.plain_cosine(axis)
                                                                       : sent.clamped_cosine(axis));
    }

    const auto node_count = static_cast<std::uint32_t>(tree_.size());
    const Float4* const sent = scratch.sent.data();
    for (std::uint32_t i = links_.bin_segments[b]; i < links_.bin_segments[b + 1]; ++i) {
        const Segment& s = links_.segments[i];
        Float4 sum{};
        for (std::uint32_t l = s.begin; l < s.end; ++l) {
            const Link& link = links_.links[l];
            const std::uint32_t offset = link.form_factor < 0 ? node_count : 0U;
            sum += link.form_factor * sent[static_cast<std::uint32_t>(link.source) + offset];
        }
        const Float4 phi = phi_[i] + damping * (kPi * sum - phi_[i]);
        if (has_antiradiance && sweep == Sweep::kFrontToBack)
            add_antiradiance(s.receiver, (phi - phi_[i]) * s.inv_c, scratch);
        phi_[i] = phi;
    }
}

// A of every node in one bin: what it and the patches above it received (pushed down), and the area
// average of what the patches below it received (pulled up). Eq. 4's J is diagonal in the bin.
void Transport::load_antiradiance(int bin, Scratch& scratch) const {
    const auto b = static_cast<std::size_t>(bin);
    std::vector<Float4>& a = scratch.antiradiance;
    std::fill(a.begin(), a.end(), Float4{});
    for (std::uint32_t i = links_.bin_segments[b]; i < links_.bin_segments[b + 1]; ++i) {
        const Segment& s = links_.segments[i];
        a[static_cast<std::size_t>(s.receiver)] = phi_[i] * s.inv_c;
    }
    Float4* const below = scratch.sent.data() + tree_.size();
    std::fill(below, below + tree_.size(), Float4{});
    for (std::size_t n = tree_.size(); n-- > 1;) {
        if (tree_.is_cluster(static_cast<NodeId>(n))) continue;
        const auto p = static_cast<std::size_t>(tree_.parent[n]);
        if (!tree_.is_cluster(tree_.parent[n]))
            below[p] += (a[n] + below[n]) * (tree_.area[n] / tree_.area[p]);
    }
    for (std::size_t n = 1; n < tree_.size(); ++n) {
        if (tree_.is_cluster(static_cast<NodeId>(n))) continue;
        if (!tree_.is_cluster(tree_.parent[n]))
            a[n] += a[static_cast<std::size_t>(tree_.parent[n])];
    }
    for (std::size_t n = 0; n < tree_.size(); ++n) {
        a[n] += below[n];
        below[n] = clamp(a[n], most_antiradiance_);
    }
}

void Transport::add_antiradiance(NodeId node, Float4 change, Scratch& scratch) const {
    Float4* const clamped = scratch.sent.data() + tree_.size();
    const auto end = static_cast<std::size_t>(tree_.subtree_end[static_cast<std::size_t>(node)]);
    for (auto n = static_cast<std::size_t>(node); n < end; ++n) {
        scratch.antiradiance[n] += change;
        clamped[n] = clamp(scratch.antiradiance[n], most_antiradiance_);
    }
    const float area = tree_.area[static_cast<std::size_t>(node)];
    for (NodeId p = tree_.parent[static_cast<std::size_t>(node)]; !tree_.is_cluster(p);
         p = tree_.parent[static_cast<std::size_t>(p)]) {
        const auto n = static_cast<std::size_t>(p);
        scratch.antiradiance[n] += change * (area / tree_.area[n]);
        clamped[n] = clamp(scratch.antiradiance[n], most_antiradiance_);
    }
}

void Transport::pull_moments(std::span<const vec3> radiance) {
    sent_.assign(tree_.size(), Moments{});
    for (std::size_t s = 0; s < tree_.surfaces.size(); ++s) {
        if (tree_.surfaces[s].lamp != kNone) continue;  // lamps link by themselves
        const auto n = static_cast<std::size_t>(tree_.surface_node[s]);
        sent_[static_cast<std::size_t>(tree_.parent[n])].add(tree_.normal[n],
                                                             tree_.area[n] * radiance[n]);
    }
    for (std::size_t n = tree_.size(); n-- > 1;) {
        if (tree_.is_cluster(static_cast<NodeId>(n)))
            sent_[static_cast<std::size_t>(tree_.parent[n])] += sent_[n];
    }
}

void Transport::push_cluster_irradiance(std::vector<vec3>& irradiance) const {
    std::vector<Moments> received(tree_.size());
    for (std::size_t n = 0; n < tree_.size(); ++n) {
        if (!tree_.is_cluster(static_cast<NodeId>(n))) continue;
        if (n > 0) received[n] = received[static_cast<std::size_t>(tree_.parent[n])];
        for (std::uint32_t i = node_segment_begin_[n]; i < node_segment_begin_[n + 1]; ++i) {
            const std::uint32_t segment = node_segments_[i];
            // Towards the source.
            received[n].add(-links_.bins.axis(segment_bin_[segment]), to_vec3(phi_[segment]));
        }
    }
    for (std::size_t s = 0; s < tree_.surfaces.size(); ++s) {
        if (tree_.surfaces[s].lamp != kNone) continue;
        const auto n = static_cast<std::size_t>(tree_.surface_node[s]);
        irradiance[n] +=
            received[static_cast<std::size_t>(tree_.parent[n])].clamped_cosine(tree_.normal[n]);
    }
}

std::vector<vec3> Transport::leaf_irradiance() const {
    std::vector<vec3> irradiance(tree_.size(), vec3(0));
    for (std::size_t n = 0; n < tree_.size(); ++n) {
        if (tree_.is_cluster(static_cast<NodeId>(n))) continue;
        Float4 sum{};
        for (std::uint32_t i = node_segment_begin_[n]; i < node_segment_begin_[n + 1]; ++i)
            sum += phi_[node_segments_[i]];
        irradiance[n] = to_vec3(sum);
    }
    if (clusters_receive_) push_cluster_irradiance(irradiance);
    for (std::size_t n = 1; n < tree_.size(); ++n) {
        if (!tree_.is_cluster(static_cast<NodeId>(n)) && !tree_.is_cluster(tree_.parent[n]))
            irradiance[n] += irradiance[static_cast<std::size_t>(tree_.parent[n])];
    }
    for (std::size_t n = 0; n < tree_.size(); ++n) {
        if (!tree_.is_leaf(static_cast<NodeId>(n))) irradiance[n] = vec3(0);
    }
    return irradiance;
}

}  // namespace antiradiance
