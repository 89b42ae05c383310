// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/link_maker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "links/pair_geometry.h"

namespace antiradiance {

namespace {

constexpr int kNearGrid = 4;  // points along a side of the source of a touching pair
// Of a touching link's form factor: smaller bins are dropped.
constexpr float kLeastBinShare = 0.02F;

// The descendants of a patch that links end at, `levels` below it or at its leaves.
template <typename Visit>
void for_receivers(const GrowingTree& tree, NodeId n, int levels, const Visit& visit) {
    const GrowingNode& node = tree.node(n);
    if (levels == 0 || node.is_leaf() || node.is_cluster()) {
        visit(n);
        return;
    }
    for (NodeId i = 0; i < node.child_count; ++i)
        for_receivers(tree, node.first_child + i, levels - 1, visit);
}

// ff without the cosine (and area) of an end that is a cluster; see Link.
float cluster_factor(const GrowingNode& s, const GrowingNode& r, const vec3& d) {
    const float d2 = glm::dot(d, d);
    const float distance = std::sqrt(d2);
    float factor = 1 / (kPi * d2);
    if (!s.is_cluster()) factor *= s.area * std::max(0.0F, glm::dot(s.normal, d)) / distance;
    if (!r.is_cluster()) factor *= std::max(0.0F, -glm::dot(r.normal, d)) / distance;
    return factor;
}

// How much of a pair's transfer goes through each bin.
class BinShares {
public:
    struct Share {
        int bin;
        float weight;
    };

    void add(int bin, float weight) {
        sum_ += weight;
        std::size_t at = 0;
        while (at < count_ && shares_[at].bin != bin)
            ++at;
        if (at == count_) shares_[count_++] = {bin, 0};
        shares_[at].weight += weight;
    }
    [[nodiscard]] float sum() const { return sum_; }
    [[nodiscard]] std::span<const Share> all() const { return {shares_.data(), count_}; }

private:
    std::array<Share, 4 * kNearGrid * kNearGrid> shares_;
    std::size_t count_ = 0;
    float sum_ = 0;
};

// By point-to-point transfer.
void find_shares(const GrowingNode& s, const GrowingNode& r, bool minus, const DirectionBins& bins,
                 BinShares& shares) {
    std::array<vec3, kNearGrid * kNearGrid> from;
    for (int i = 0; i < kNearGrid * kNearGrid; ++i) {
        const vec2 u = (vec2(i % kNearGrid, i / kNearGrid) + 0.5F) / static_cast<float>(kNearGrid);
        from[static_cast<std::size_t>(i)] = point_of(s, u);
    }
    for (int k = 0; k < 4; ++k) {
        const vec3 to = point_of(r, {k % 2 ? 0.75F : 0.25F, k / 2 ? 0.75F : 0.25F});
        for (const vec3& point : from) {
            const vec3 d = to - point;
            const float d2 = glm::dot(d, d);
            const float cos_s = glm::dot(s.normal, d) * (minus ? -1.0F : 1.0F);
            const float cos_r = -glm::dot(r.normal, d);
            if (cos_s <= 0 || cos_r <= 0) continue;
            shares.add(bins.bin(d), cos_s * cos_r / (d2 * d2));
        }
    }
}

RawLink raw_link(NodeId source, NodeId receiver, float ff, bool minus, int bin) {
    return {receiver, source, minus ? -ff : ff, static_cast<std::uint16_t>(bin)};
}

}  // namespace

void LinkMaker::link(NodeId a, NodeId b, const Verdict& verdict, RefinedLinks& out) const {
    const bool shared = tree_.node(a).is_leaf() && tree_.node(b).is_leaf();
    auto first = static_cast<std::uint32_t>(out.links.size());
    const auto end_pair = [&](NodeId one, NodeId other) {
        const auto end = static_cast<std::uint32_t>(out.links.size());
        if (end > first) out.pairs.push_back({one, other, first, end - first});
        first = end;
    };
    const auto plus = [&](NodeId source, NodeId receiver) {
        for_receivers(tree_, receiver, options_.receiver_levels, [&](NodeId r) {
            add_links(source, r, false, verdict.touching, out.links);
            if (!shared) end_pair(source, r);
        });
    };
    if (verdict.to_b.plus) plus(a, b);
    if (verdict.to_a.plus) plus(b, a);
    if (shared) end_pair(a, b);

    const auto minus = [&](NodeId source, NodeId receiver) {
        for_receivers(tree_, receiver, options_.receiver_levels,
                      [&](NodeId r) { add_links(source, r, true, verdict.touching, out.links); });
    };
    if (verdict.to_b.minus) minus(a, b);
    if (verdict.to_a.minus) minus(b, a);
}

LinkCount LinkMaker::count(NodeId a, NodeId b, const Verdict& verdict) const {
    LinkCount sum;
    const auto add = [&](NodeId receiver, const LinkSigns& signs) {
        if (!signs.any()) return;
        for_receivers(tree_, receiver, options_.receiver_levels, [&](NodeId) {
            sum.radiance += signs.plus ? 1 : 0;
            sum.antiradiance += signs.minus ? 1 : 0;
        });
    };
    add(b, verdict.to_b);
    add(a, verdict.to_a);
    return sum;
}

void LinkMaker::add_links(NodeId source, NodeId receiver, bool minus, bool touching,
                          std::vector<RawLink>& out) const {
    const GrowingNode& s = tree_.node(source);
    const GrowingNode& r = tree_.node(receiver);
    const vec3 d = r.center - s.center;
    if (s.is_cluster() || r.is_cluster()) {
        const float ff = cluster_factor(s, r, d);
        if (ff > 0) out.push_back(raw_link(source, receiver, ff, minus, bins_.bin(d)));
        return;
    }
    const float ff = patch_form_factor(s, r, minus);
    if (ff <= 0) return;
    if (touching && (options_.antiradiance || options_.spread_touching)) {
        spread_over_bins(source, receiver, ff, minus, out);
    } else {
        out.push_back(raw_link(source, receiver, ff, minus, bins_.bin(d)));
    }
}

// Touching pairs see each other through many bins.
void LinkMaker::spread_over_bins(NodeId source, NodeId receiver, float ff, bool minus,
                                 std::vector<RawLink>& out) const {
    const GrowingNode& s = tree_.node(source);
    const GrowingNode& r = tree_.node(receiver);
    BinShares shares;
    find_shares(s, r, minus, bins_, shares);
    if (shares.sum() <= 0) {
        out.push_back(raw_link(source, receiver, ff, minus, bins_.bin(r.center - s.center)));
        return;
    }
    const float least = kLeastBinShare * shares.sum();
    float kept = 0;
    for (const BinShares::Share& share : shares.all()) {
        if (share.weight >= least) kept += share.weight;
    }
    for (const BinShares::Share& share : shares.all()) {
        if (share.weight >= least)
            out.push_back(raw_link(source, receiver, ff * share.weight / kept, minus, share.bin));
    }
}

}  // namespace antiradiance
