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
    // so that the sign of a link is an offset and the inner loop has no branch.  // 1 or 2 #nodes
    std::vector<Float4> sent;
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
    index_segments();
    index_antiradiance();
}

void Transport::index_segments() {
    for (const Segment& s : links_.segments)
        ++node_segment_begin_[static_cast<std::size_t>(s.receiver) + 1];
    for (std::size_t n = 0; n < tree_.size(); ++n)
        node_segment_begin_[n + 1] += node_segment_begin_[n];
    std::vector<std::uint32_t> fill(node_segment_begin_.begin(), node_segment_begin_.end() - 1);
    std::vector<std::int32_t> last_bin(tree_.size(), -1);
    for (int b = 0; b < links_.bins.count(); ++b) {
        for (std::uint32_t i = links_.bin_segments[static_cast<std::size_t>(b)];
             i < links_.bin_segments[static_cast<std::size_t>(b) + 1]; ++i) {
            const Segment& s = links_.segments[i];
            segment_bin_[i] = b;
            node_segments_[fill[static_cast<std::size_t>(s.receiver)]++] = i;
            clusters_receive_ = clusters_receive_ || tree_.is_cluster(s.receiver);
            for (std::uint32_t l = s.begin; l < s.end; ++l) {
                const NodeId source = links_.links[l].source;
                std::int32_t& last = last_bin[static_cast<std::size_t>(source)];
                if (!tree_.is_cluster(source) || last == b) continue;
                last = b;
                bin_clusters_[static_cast<std::size_t>(b)].push_back(source);
                clusters_send_ = true;
            }
        }
    }
}

void Transport::index_antiradiance() {
    bin_passing_.assign(bin_clusters_.size() + 1, 0);
    if (links_.antiradiance_count == 0) return;
    std::vector<std::uint32_t> segment_of(tree_.size(), 0);
    for (int b = 0; b < links_.bins.count(); ++b) {
        index_antiradiance(b, segment_of);
        bin_passing_[static_cast<std::size_t>(b) + 1] = static_cast<std::uint32_t>(passing_.size());
    }
}

// segment_of: #nodes, scratch; 1 + number of a node's segment in this bin, 0: none.
void Transport::index_antiradiance(int bin, std::vector<std::uint32_t>& segment_of) {
    const std::uint32_t begin = links_.bin_segments[static_cast<std::size_t>(bin)];
    const std::uint32_t end = links_.bin_segments[static_cast<std::size_t>(bin) + 1];
    std::fill(segment_of.begin(), segment_of.end(), 0U);
    for (std::uint32_t i = begin; i < end; ++i)
        segment_of[static_cast<std::size_t>(links_.segments[i].receiver)] = i + 1;

    std::vector<char> seen(tree_.size(), 0);
    const auto contribute = [&](NodeId n, float share) {
        const std::uint32_t segment = segment_of[static_cast<std::size_t>(n)];
        if (segment > 0)
            contributions_.push_back({segment - 1, share * links_.segments[segment - 1].inv_c});
    };
    for (std::uint32_t i = begin; i < end; ++i) {
        const Segment& s = links_.segments[i];
        for (std::uint32_t l = s.begin; l < s.end; ++l) {
            const NodeId source = links_.links[l].source;
            const auto n = static_cast<std::size_t>(source);
            if (links_.links[l].form_factor > 0 || seen[n]) continue;
            seen[n] = 1;
            Passing passing{source, i, static_cast<std::uint32_t>(contributions_.size()), 0};
            for (NodeId up = source; !tree_.is_cluster(up);
                 up = tree_.parent[static_cast<std::size_t>(up)])
                contribute(up, 1);
            for (NodeId down = source + 1; down < tree_.subtree_end[n]; ++down)
                contribute(down, tree_.area[static_cast<std::size_t>(down)] / tree_.area[n]);
            passing.end = static_cast<std::uint32_t>(contributions_.size());
            passing_.push_back(passing);
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
            if (links_.antiradiance_count > 0) mine.sent.resize(2 * radiance_.size());
        }
        gather_bin(static_cast<int>(bin), sweep, damping, mine);
    });
}

void Transport::gather_bin(int bin, Sweep sweep, float damping, Scratch& scratch) {
    const auto b = static_cast<std::size_t>(bin);
    load_clusters(bin, scratch);
    const Passing* passing = passing_.data() + bin_passing_[b];
    const Passing* const passing_end = passing_.data() + bin_passing_[b + 1];
    if (sweep == Sweep::kJacobi) {
        for (; passing != passing_end; ++passing)
            load_antiradiance(*passing, scratch);
    }

    const auto node_count = static_cast<std::uint32_t>(tree_.size());
    const Float4* const sent = scratch.sent.data();
    for (std::uint32_t i = links_.bin_segments[b]; i < links_.bin_segments[b + 1]; ++i) {
        // Front to back: by now all segments in front of these nodes have their new Phi.
        for (; passing != passing_end && passing->first_use == i; ++passing)
            load_antiradiance(*passing, scratch);
        const Segment& s = links_.segments[i];
        Float4 sum{};
        for (std::uint32_t l = s.begin; l < s.end; ++l) {
            const Link& link = links_.links[l];
            const std::uint32_t offset = link.form_factor < 0 ? node_count : 0U;
            sum += link.form_factor * sent[static_cast<std::uint32_t>(link.source) + offset];
        }
        phi_[i] += damping * (kPi * sum - phi_[i]);
    }
}

void Transport::load_clusters(int bin, Scratch& scratch) const {
    const vec3 axis = links_.bins.axis(bin);
    for (const NodeId c : bin_clusters_[static_cast<std::size_t>(bin)]) {
        const auto n = static_cast<std::size_t>(c);
        scratch.sent[n] =
            to_float4(tree_.cone_cosine[n] > kNarrowCone ? sent_[n].plain_cosine(axis)
                                                         : sent_[n].clamped_cosine(axis));
    }
}

// J of Eq. 4, diagonal in the bin, and the clamp that keeps the solve bounded (algorithm.md "It can
// diverge").
void Transport::load_antiradiance(const Passing& passing, Scratch& scratch) const {
    Float4 a{};
    for (std::uint32_t c = passing.begin; c < passing.end; ++c)
        a += contributions_[c].weight * phi_[contributions_[c].segment];
    scratch.sent[tree_.size() + static_cast<std::size_t>(passing.node)] =
        clamp(a, most_antiradiance_);
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
