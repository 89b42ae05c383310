// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/transport.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <bit>

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
    // J Phi of the bin's segments by receiver, 0 elsewhere.  // #nodes if there are - links
    std::vector<Float4> passed;
};

Transport::Transport(const PatchTree& tree, const LinkSet& links)
    : tree_(tree),
      links_(links),
      radiance_(tree.size()),
      phi_(links.segments.size(), vec3(0)),
      bin_clusters_(static_cast<std::size_t>(links.bins.count())) {
    branches_.reserve(tree.size());
    for (std::size_t n = 0; n < tree.size(); ++n) {
        const NodeId parent = tree.parent[n];
        const bool is_root = parent == kNone || tree.is_cluster(parent);
        branches_.push_back({is_root ? kNone : parent, tree.subtree_end[n], tree.area[n]});
    }
    index_links();
}

std::size_t Transport::bytes() const {
    return phi_.size() * sizeof(vec3) + passing_.size() * sizeof(Passing) +
           bin_passing_.size() * sizeof(std::uint32_t);
}

void Transport::index_links() {
    bin_passing_.push_back(0);
    std::vector<std::int32_t> last_sent(tree_.size(), kNone);    // bin in which a node last sent L
    std::vector<std::int32_t> last_passed(tree_.size(), kNone);  // and A
    for (int b = 0; b < links_.bins.count(); ++b) {
        const auto bin = static_cast<std::size_t>(b);
        for (std::uint32_t i = links_.bin_segments[bin]; i < links_.bin_segments[bin + 1]; ++i) {
            const Segment& s = links_.segments[i];
            clusters_receive_ = clusters_receive_ || tree_.is_cluster(s.receiver);
            for (std::uint32_t l = s.begin; l < s.end; ++l) {
                const Link& link = links_.links[l];
                const bool minus = link.form_factor < 0;
                const NodeId source = link.source;
                if (!minus && !tree_.is_cluster(source)) continue;
                std::int32_t& last =
                    (minus ? last_passed : last_sent)[static_cast<std::size_t>(source)];
                if (last == b) continue;
                last = b;
                if (minus) {
                    passing_.push_back({source, i});
                } else {
                    bin_clusters_[bin].push_back(source);
                    clusters_send_ = true;
                }
            }
        }
        bin_passing_.push_back(static_cast<std::uint32_t>(passing_.size()));
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
    if (clusters_send_) sent_ = pull_moments(tree_, radiance);
    tbb::enumerable_thread_specific<Scratch> scratch;
    parallel_for(static_cast<std::size_t>(links_.bins.count()), progress, [&](std::size_t bin) {
        Scratch& mine = scratch.local();
        if (mine.sent.empty()) {
            mine.sent = radiance_;
            if (links_.antiradiance_count > 0) {
                mine.sent.resize(2 * radiance_.size());
                mine.passed.assign(radiance_.size(), Float4{});
            }
        }
        gather_bin(static_cast<int>(bin), sweep, damping, mine);
    });
}

void Transport::gather_bin(int bin, Sweep sweep, float damping, Scratch& scratch) {
    const auto b = static_cast<std::size_t>(bin);
    load_clusters(bin, scratch);
    const std::span<const Segment> segments(links_.segments.data() + links_.bin_segments[b],
                                            links_.bin_segments[b + 1] - links_.bin_segments[b]);
    const bool antiradiance = links_.antiradiance_count > 0;
    const auto pass = [&](const Segment& s, const Float4& phi) {
        if (antiradiance) scratch.passed[static_cast<std::size_t>(s.receiver)] = s.inv_c * phi;
    };
    std::uint32_t i = links_.bin_segments[b];
    for (const Segment& s : segments)
        pass(s, to_float4(phi_[i++]));

    const Passing* passing = passing_.data() + bin_passing_[b];
    const Passing* const passing_end = passing_.data() + bin_passing_[b + 1];
    if (sweep == Sweep::kJacobi) {
        for (; passing != passing_end; ++passing)
            load_antiradiance(passing->node, scratch);
    }

    const auto node_count = static_cast<std::uint32_t>(tree_.size());
    const Float4* const sent = scratch.sent.data();
    i = links_.bin_segments[b];
    for (const Segment& s : segments) {
        // Front to back: by now all segments in front of these nodes have their new Phi.
        for (; passing != passing_end && passing->first_use == i; ++passing)
            load_antiradiance(passing->node, scratch);
        Float4 sum{};
        for (std::uint32_t l = s.begin; l < s.end; ++l) {
            const Link& link = links_.links[l];
            const std::uint32_t minus = std::bit_cast<std::uint32_t>(link.form_factor) >> 31U;
            sum += link.form_factor *
                   sent[static_cast<std::uint32_t>(link.source) + minus * node_count];
        }
        const Float4 before = to_float4(phi_[i]);
        const Float4 phi = before + damping * (kPi * sum - before);
        phi_[i++] = to_vec3(phi);
        pass(s, phi);
    }
    for (const Segment& s : segments)
        pass(s, Float4{});
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

// The antiradiance of a node: of the patches above it pushed down, its own, and that of those below
// pulled up; with the clamp that keeps the solve bounded (algorithm.md "It can diverge").
void Transport::load_antiradiance(NodeId node, Scratch& scratch) const {
    const auto n = static_cast<std::size_t>(node);
    const Branch& own = branches_[n];
    Float4 a = scratch.passed[n];
    if (own.subtree_end > node + 1) {
        Float4 below{};
        for (auto down = n + 1; down < static_cast<std::size_t>(own.subtree_end); ++down)
            below += branches_[down].area * scratch.passed[down];
        a += below / own.area;
    }
    for (NodeId up = own.parent; up != kNone; up = branches_[static_cast<std::size_t>(up)].parent)
        a += scratch.passed[static_cast<std::size_t>(up)];
    scratch.sent[tree_.size() + n] = clamp(a, most_antiradiance_);
}

// What arrived at clusters, down to the surfaces below.
void Transport::push_moments(std::vector<Moments>& received, std::vector<vec3>& irradiance) const {
    for (std::size_t n = 1; n < tree_.size(); ++n) {
        if (tree_.is_cluster(static_cast<NodeId>(n)))
            received[n] += received[static_cast<std::size_t>(tree_.parent[n])];
    }
    for (std::size_t s = 0; s < tree_.surfaces.size(); ++s) {
        if (tree_.surfaces[s].lamp != kNone) continue;
        const auto n = static_cast<std::size_t>(tree_.surface_node[s]);
        irradiance[n] +=
            received[static_cast<std::size_t>(tree_.parent[n])].clamped_cosine(tree_.normal[n]);
    }
}

std::vector<vec3> Transport::leaf_irradiance(std::span<const std::uint8_t> rows) const {
    std::vector<vec3> irradiance(tree_.size(), vec3(0));
    std::vector<Moments> received(clusters_receive_ ? tree_.size() : 0);
    for (std::size_t b = 0; b + 1 < links_.bin_segments.size(); ++b) {
        const vec3 to_source = -links_.bins.axis(static_cast<int>(b));
        for (std::uint32_t i = links_.bin_segments[b]; i < links_.bin_segments[b + 1]; ++i) {
            if (!rows.empty() && !rows[i]) continue;
            const NodeId receiver = links_.segments[i].receiver;
            if (tree_.is_cluster(receiver)) {
                received[static_cast<std::size_t>(receiver)].add(to_source, phi_[i]);
            } else {
                irradiance[static_cast<std::size_t>(receiver)] += phi_[i];
            }
        }
    }
    if (clusters_receive_) push_moments(received, irradiance);
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
