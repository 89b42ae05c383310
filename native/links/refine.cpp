// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/refine.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "links/form_factor.h"
#include "links/pair_geometry.h"

namespace antiradiance {

namespace {

constexpr std::size_t kBlock = 256;         // pairs handed to a thread at once
constexpr std::size_t kEnoughPairs = 2048;  // to share out between threads
constexpr float kStraddlingShare = 0.25F;   // of eps
constexpr float kMostNegligible = 8;        // eps, of a form factor whose exchange is negligible
constexpr int kNearGrid = 4;                // points along a side of the source of a touching pair
constexpr float kLeastBinShare =
    0.02F;  // of a touching link's form factor: smaller bins are dropped

struct Pair {
    NodeId a, b;
};

// A pair that waits for a leaf patch to get children.
struct Waiting {
    Pair pair;
    NodeId split;
};

// Which links run from one end to the other: + where the receiver lies in front of the source, -
// where it lies behind; both where it straddles the source's plane.
struct Signs {
    bool plus = false;
    bool minus = false;
    [[nodiscard]] bool any() const { return plus || minus; }
};

struct Verdict {
    enum { kDrop, kLink, kSplitA, kSplitB } action = kDrop;
    Signs to_b;  // a -> b
    Signs to_a;  // b -> a
    bool touching = false;
};

struct BlockResult {
    std::vector<RawLink> links;
    std::vector<LinkedPair> pairs;
    std::vector<Waiting> waiting;
    std::vector<Pair> stack;
};

class Refiner {
public:
    Refiner(const GrowingTree& tree, const DirectionBins& bins, const RefineOptions& options)
        : tree_(tree),
          bins_(bins),
          options_(options),
          widest_(options.bin_share * bins.mean_solid_angle()) {}

    // Handles one pair and, through `out.stack`, the pairs that come from it.
    void refine(const Pair& pair, BlockResult& out) const {
        out.stack.push_back(pair);
        while (!out.stack.empty()) {
            const Pair p = out.stack.back();
            out.stack.pop_back();
            step(p, out);
        }
    }

    void step(const Pair& p, BlockResult& out) const {
        if (p.a == p.b) {
            push_self_pairs(p.a, out);
            return;
        }
        const Verdict v = decide(p);
        switch (v.action) {
            case Verdict::kDrop:
                return;
            case Verdict::kLink:
                link(p, v, out);
                return;
            case Verdict::kSplitA:
                push_children(p.a, p, out);
                return;
            case Verdict::kSplitB:
                push_children(p.b, p, out);
                return;
        }
    }

private:
    void push_self_pairs(NodeId n, BlockResult& out) const {
        const GrowingNode& node = tree_.node(n);
        if (!node.is_cluster()) return;  // a plane does not see itself
        for (NodeId i = 0; i < node.child_count; ++i) {
            for (NodeId j = i; j < node.child_count; ++j)
                out.stack.push_back({node.first_child + i, node.first_child + j});
        }
    }

    void push_children(NodeId split, const Pair& p, BlockResult& out) const {
        const GrowingNode& node = tree_.node(split);
        if (node.is_leaf()) {
            out.waiting.push_back({p, split});
            return;
        }
        const NodeId other = split == p.a ? p.b : p.a;
        for (NodeId i = node.child_count; i-- > 0;) {
            const NodeId child = node.first_child + i;
            out.stack.push_back(split == p.a ? Pair{child, other} : Pair{other, child});
        }
    }

    [[nodiscard]] bool can_split(const GrowingNode& n) const {
        return !n.is_leaf() || n.longest_edge > options_.least_edge;
    }

    // Splits the larger end, or the other where it can't; false: neither can be split.
    [[nodiscard]] bool split_larger(const GrowingNode& a, const GrowingNode& b, Verdict& v) const {
        const bool a_first = a.radius >= b.radius;
        const bool can_a = can_split(a);
        const bool can_b = can_split(b);
        if (!can_a && !can_b) return false;
        v.action = (a_first && can_a) || !can_b ? Verdict::kSplitA : Verdict::kSplitB;
        return true;
    }

    [[nodiscard]] Verdict decide(const Pair& p) const {
        const GrowingNode& a = tree_.node(p.a);
        const GrowingNode& b = tree_.node(p.b);
        if (a.is_cluster() || b.is_cluster()) return decide_clusters(a, b);

        Verdict v;
        if (a.emits_only && b.emits_only) return v;
        const PlaneSide a_side = side_of_plane(a, b);
        const PlaneSide b_side = side_of_plane(b, a);
        if (a_side == PlaneSide::kBehind && b_side == PlaneSide::kBehind) return v;
        if (!options_.antiradiance &&
            (a_side == PlaneSide::kBehind || b_side == PlaneSide::kBehind))
            return v;
        v.to_b = signs(a, b, a_side, b_side);
        v.to_a = signs(b, a, b_side, a_side);
        if (!v.to_a.any() && !v.to_b.any()) return v;

        const vec3 d = b.center - a.center;
        const float d2 = glm::dot(d, d);
        const float reach = a.radius + b.radius;
        v.touching = d2 < reach * reach;
        const bool straddles = a_side == PlaneSide::kStraddles || b_side == PlaneSide::kStraddles;
        const bool fine = v.touching ? both_negligible(a, b) : small_enough(a, b, d, d2, straddles);
        if (!fine && split_larger(a, b, v)) return v;
        v.action = Verdict::kLink;
        return v;
    }

    // Light arrives on fronts: the source must be in front of the receiver, at least in part. Lamps
    // receive none and, as they block none, send no antiradiance.
    [[nodiscard]] Signs signs(const GrowingNode& source, const GrowingNode& receiver,
                              PlaneSide source_at, PlaneSide receiver_at) const {
        if (source_at == PlaneSide::kBehind || receiver.emits_only) return {};
        return {receiver_at != PlaneSide::kBehind,
                receiver_at != PlaneSide::kInFront && !source.emits_only && options_.antiradiance};
    }

    // Both form factors below eps (a quarter of it where one end straddles the other's plane, since
    // the form factor varies most there) and both solid angles below k bins.
    [[nodiscard]] bool small_enough(const GrowingNode& a, const GrowingNode& b, const vec3& d,
                                    float d2, bool straddles) const {
        const float distance = std::sqrt(d2);
        // A centre's cosine says little of a patch seen edge-on; its radius bounds what it hides.
        const float cos_a = std::max(std::abs(glm::dot(a.normal, d)), 0.5F * b.radius) / distance;
        const float cos_b = std::max(std::abs(glm::dot(b.normal, d)), 0.5F * a.radius) / distance;
        const float solid_a = a.area * cos_a / d2;
        const float solid_b = b.area * cos_b / d2;
        const float eps = options_.link_threshold * kPi * (straddles ? kStraddlingShare : 1.0F) *
                          (emits(a) || emits(b) ? options_.emitter_share : 1.0F);
        if (negligible(solid_a * cos_b * b.area, std::min(a.area, b.area), eps)) return true;
        return solid_a * cos_b < eps && solid_b * cos_a < eps && solid_a < widest_ &&
               solid_b < widest_;
    }

    [[nodiscard]] bool emits(const GrowingNode& patch) const {
        return tree_.surfaces()[static_cast<std::size_t>(patch.surface)].emits;
    }

    // Slivers and the small parts of a detailed model: what two of them exchange is less than what
    // the oracle lets through between two patches of the least size, whatever their form factors
    // (refinement by B F A, Hanrahan, Salzman & Aupperle 1991). Antiradiance needs the direction of
    // every link, so that IMPLICIT can't do without the size of both ends.
    // exchange: pi A F, m2; eps: pi times the threshold.
    [[nodiscard]] bool negligible(float exchange, float smaller_area, float eps) const {
        return !options_.antiradiance && exchange < eps * least_area() &&
               exchange < kMostNegligible * eps * smaller_area;
    }

    // Touching ends have no form factor to go by, but 1 is the most.
    [[nodiscard]] bool both_negligible(const GrowingNode& a, const GrowingNode& b) const {
        const float most = options_.link_threshold * least_area();
        return !options_.antiradiance && a.area < most && b.area < most;
    }

    [[nodiscard]] float least_area() const { return options_.least_edge * options_.least_edge; }

    [[nodiscard]] Verdict decide_clusters(const GrowingNode& a, const GrowingNode& b) const {
        Verdict v;
        const bool a_receives = may_receive(a, b);
        const bool b_receives = may_receive(b, a);
        const bool lit =
            options_.antiradiance ? a_receives || b_receives : a_receives && b_receives;
        if (!lit || (a.emits_only && b.emits_only)) return v;

        if (options_.cluster_links && !a.emits_only && !b.emits_only && clusters_are_far(a, b)) {
            v.action = Verdict::kLink;
            v.to_a.plus = v.to_b.plus = true;
            return v;
        }
        // Where one end is a patch, refine the cluster first: the patch may be fine as it is.
        const bool a_larger = a.is_cluster() && (!b.is_cluster() || a.radius >= b.radius);
        if (options_.cluster_links && !(a.is_cluster() && b.is_cluster())) {
            if (split_larger(a, b, v)) return v;
        }
        v.action = a_larger ? Verdict::kSplitA : Verdict::kSplitB;
        return v;
    }

    [[nodiscard]] bool clusters_are_far(const GrowingNode& a, const GrowingNode& b) const {
        // A cluster above one surface (the root may be) or below the root only.
        const vec3 d = b.center - a.center;
        const float d2 = glm::dot(d, d);
        const float reach = a.radius + b.radius;
        if (d2 <= reach * reach) return false;
        const float floor = options_.cluster_floor;
        if (a.radius < floor && b.radius < floor) return true;
        const auto face = [](const GrowingNode& n) {
            return std::min(n.area, kPi * n.radius * n.radius);
        };
        // Part of one end below the other's horizon: the moments know no horizon, so be finer.
        const bool straddles = (!a.is_cluster() && std::abs(glm::dot(d, a.normal)) < b.radius) ||
                               (!b.is_cluster() && std::abs(glm::dot(d, b.normal)) < a.radius);
        const float eps = options_.link_threshold * kPi * (straddles ? kStraddlingShare : 1.0F);
        if (negligible(face(a) * face(b) / d2, std::min(face(a), face(b)), eps)) return true;
        return face(a) < eps * d2 && face(b) < eps * d2 && face(a) < widest_ * d2 &&
               face(b) < widest_ * d2;
    }

    void link(const Pair& p, const Verdict& v, BlockResult& out) const {
        const bool shared = tree_.node(p.a).is_leaf() && tree_.node(p.b).is_leaf();
        auto first = static_cast<std::uint32_t>(out.links.size());
        const auto end_pair = [&](NodeId a, NodeId b) {
            const auto end = static_cast<std::uint32_t>(out.links.size());
            if (end > first) out.pairs.push_back({a, b, first, end - first});
            first = end;
        };
        const auto plus = [&](NodeId source, NodeId receiver) {
            for_receivers(receiver, options_.receiver_levels, [&](NodeId r) {
                add_links(source, r, false, v.touching, out);
                if (!shared) end_pair(source, r);
            });
        };
        if (v.to_b.plus) plus(p.a, p.b);
        if (v.to_a.plus) plus(p.b, p.a);
        if (shared) end_pair(p.a, p.b);

        const auto minus = [&](NodeId source, NodeId receiver) {
            for_receivers(receiver, options_.receiver_levels,
                          [&](NodeId r) { add_links(source, r, true, v.touching, out); });
        };
        if (v.to_b.minus) minus(p.a, p.b);
        if (v.to_a.minus) minus(p.b, p.a);
    }

    // The descendants of a patch that links end at, `levels` below it or at its leaves.
    template <typename Visit>
    void for_receivers(NodeId n, int levels, const Visit& visit) const {
        const GrowingNode& node = tree_.node(n);
        if (levels == 0 || node.is_leaf() || node.is_cluster()) {
            visit(n);
            return;
        }
        for (NodeId i = 0; i < node.child_count; ++i)
            for_receivers(node.first_child + i, levels - 1, visit);
    }

    void add_links(NodeId source, NodeId receiver, bool minus, bool touching,
                   BlockResult& out) const {
        const GrowingNode& s = tree_.node(source);
        const GrowingNode& r = tree_.node(receiver);
        const vec3 d = r.center - s.center;
        if (s.is_cluster() || r.is_cluster()) {
            const float ff = cluster_factor(s, r, d);
            if (ff > 0) add(receiver, source, ff, minus, bins_.bin(d), out);
            return;
        }
        const float ff = patch_form_factor(s, r, minus);
        if (ff <= 0) return;
        if (!touching || !(options_.antiradiance || options_.spread_touching)) {
            add(receiver, source, ff, minus, bins_.bin(d), out);
            return;
        }
        spread_over_bins(receiver, source, ff, minus, out);
    }

    // ff without the cosine (and area) of an end that is a cluster; see Link.
    static float cluster_factor(const GrowingNode& s, const GrowingNode& r, const vec3& d) {
        const float d2 = glm::dot(d, d);
        const float distance = std::sqrt(d2);
        float factor = 1 / (kPi * d2);
        if (!s.is_cluster()) factor *= s.area * std::max(0.0F, glm::dot(s.normal, d)) / distance;
        if (!r.is_cluster()) factor *= std::max(0.0F, -glm::dot(r.normal, d)) / distance;
        return factor;
    }

    // Touching pairs see each other through many bins: shares by point-to-point transfer.
    void spread_over_bins(NodeId receiver, NodeId source, float ff, bool minus,
                          BlockResult& out) const {
        const GrowingNode& s = tree_.node(source);
        const GrowingNode& r = tree_.node(receiver);
        struct Share {
            int bin;
            float weight;
        };
        std::array<Share, 4 * kNearGrid * kNearGrid> shares;
        std::size_t count = 0;
        float sum = 0;
        for (int k = 0; k < 4; ++k) {
            const vec3 to = point_of(r, {k % 2 ? 0.75F : 0.25F, k / 2 ? 0.75F : 0.25F});
            for (int i = 0; i < kNearGrid * kNearGrid; ++i) {
                const vec2 u =
                    (vec2(i % kNearGrid, i / kNearGrid) + 0.5F) / static_cast<float>(kNearGrid);
                const vec3 d = to - point_of(s, u);
                const float d2 = glm::dot(d, d);
                const float cos_s = glm::dot(s.normal, d) * (minus ? -1.0F : 1.0F);
                const float cos_r = -glm::dot(r.normal, d);
                if (cos_s <= 0 || cos_r <= 0) continue;
                const float weight = cos_s * cos_r / (d2 * d2);
                const int bin = bins_.bin(d);
                sum += weight;
                std::size_t at = 0;
                while (at < count && shares[at].bin != bin)
                    ++at;
                if (at == count) shares[count++] = {bin, 0};
                shares[at].weight += weight;
            }
        }
        if (sum <= 0) {
            add(receiver, source, ff, minus, bins_.bin(r.center - s.center), out);
            return;
        }
        float kept = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (shares[i].weight >= kLeastBinShare * sum) kept += shares[i].weight;
        }
        for (std::size_t i = 0; i < count; ++i) {
            if (shares[i].weight >= kLeastBinShare * sum)
                add(receiver, source, ff * shares[i].weight / kept, minus, shares[i].bin, out);
        }
    }

    static void add(NodeId receiver, NodeId source, float ff, bool minus, int bin,
                    BlockResult& out) {
        out.links.push_back({receiver, source, minus ? -ff : ff, static_cast<std::uint16_t>(bin)});
    }

    const GrowingTree& tree_;
    const DirectionBins& bins_;
    const RefineOptions& options_;
    float widest_;  // sr
};

// Breadth first until there is enough to share out; in order, so that results are deterministic.
std::vector<Pair> first_pairs(const Refiner& refiner, std::vector<BlockResult>& results) {
    std::vector<Pair> pairs{{GrowingTree::kRoot, GrowingTree::kRoot}};
    BlockResult& out = results.emplace_back();
    while (!pairs.empty() && pairs.size() < kEnoughPairs) {
        for (const Pair& p : pairs)
            refiner.step(p, out);
        pairs.swap(out.stack);
        out.stack.clear();
    }
    return pairs;
}

void append(RefinedLinks& all, BlockResult& block) {
    const auto offset = static_cast<std::uint32_t>(all.links.size());
    all.links.insert(all.links.end(), block.links.begin(), block.links.end());
    for (LinkedPair p : block.pairs) {
        p.first += offset;
        all.pairs.push_back(p);
    }
    block = {};
}

}  // namespace

void RefinedLinks::renumber(const std::vector<NodeId>& number) {
    const auto to = [&](NodeId n) { return number[static_cast<std::size_t>(n)]; };
    for (RawLink& l : links) {
        l.receiver = to(l.receiver);
        l.source = to(l.source);
    }
    for (LinkedPair& p : pairs) {
        p.a = to(p.a);
        p.b = to(p.b);
    }
}

RefinedLinks refine_links(GrowingTree& tree, const DirectionBins& bins,
                          const RefineOptions& options, Progress& progress) {
    const Refiner refiner(tree, bins, options);
    RefinedLinks all;
    std::vector<BlockResult> results;
    std::vector<Pair> pairs = first_pairs(refiner, results);
    std::vector<Waiting> waiting = std::move(results.front().waiting);
    append(all, results.front());

    std::atomic<std::size_t> link_count{all.links.size()};
    float done = 0;
    while (true) {
        results.clear();
        results.resize((pairs.size() + kBlock - 1) / kBlock);
        const ProgressSpan span{done, done + 0.6F * (1 - done)};
        parallel_for_blocks(
            pairs.size(), kBlock, progress,
            [&](std::size_t begin, std::size_t end) {
                BlockResult& out = results[begin / kBlock];
                for (std::size_t i = begin; i < end; ++i) {
                    const std::size_t before = out.links.size();
                    refiner.refine(pairs[i], out);
                    progress.check();
                    if ((link_count += out.links.size() - before) > options.most_links) return;
                }
            },
            span);
        if (link_count > options.most_links) {
            throw SceneError(
                "The link mesh would need more than " + std::to_string(options.most_links) +
                " links, which do not fit into this machine's memory: raise Link Threshold or "
                "Max Patch Size, or set Visibility to Explicit");
        }
        done = span.end;
        for (BlockResult& block : results) {
            waiting.insert(waiting.end(), block.waiting.begin(), block.waiting.end());
            append(all, block);
        }
        if (waiting.empty()) return all;

        // The leaves that pairs wait for, once each; then those pairs go on.
        pairs.clear();
        for (const Waiting& w : waiting) {
            if (tree.node(w.split).is_leaf()) tree.split(w.split);
            pairs.push_back(w.pair);
        }
        waiting.clear();
    }
}

}  // namespace antiradiance
