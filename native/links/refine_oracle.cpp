// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/refine_oracle.h"

#include <algorithm>
#include <cmath>

namespace antiradiance {

namespace {

constexpr float kStraddlingShare = 0.25F;  // of eps
constexpr float kMostNegligible = 8;       // eps, of a form factor whose exchange is negligible

}  // namespace

RefineOracle::RefineOracle(const GrowingTree& tree, const DirectionBins& bins,
                           const RefineOptions& options)
    : tree_(tree), options_(options), widest_(options.bin_share * bins.mean_solid_angle()) {
    if (!options.cluster_links || options.planes == nullptr || options.planes->empty()) return;
    cut_in_two_.resize(tree.size());
    for (std::size_t n = 0; n < tree.size(); ++n) {
        const GrowingNode& node = tree.node(static_cast<NodeId>(n));
        cut_in_two_[n] = node.is_cluster() && options.planes->near(node.center, node.radius);
    }
}

// What is declared inline here is called in one place, for each of millions of pairs.

Verdict RefineOracle::decide(NodeId a, NodeId b) const {
    const GrowingNode& first = tree_.node(a);
    const GrowingNode& second = tree_.node(b);
    if (!first.is_cluster() && !second.is_cluster()) return decide_patches(first, second);
    return decide_clusters(first, second, !may_be_cut_in_two(a) && !may_be_cut_in_two(b));
}

inline Verdict RefineOracle::decide_patches(const GrowingNode& a, const GrowingNode& b) const {
    Verdict v;
    if (a.emits_only && b.emits_only) return v;
    const PlaneSide a_side = side_of_plane(a, b);
    const PlaneSide b_side = side_of_plane(b, a);
    if (a_side == PlaneSide::kBehind && b_side == PlaneSide::kBehind) return v;
    if (!options_.antiradiance && (a_side == PlaneSide::kBehind || b_side == PlaneSide::kBehind))
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
LinkSigns RefineOracle::signs(const GrowingNode& source, const GrowingNode& receiver,
                              PlaneSide source_at, PlaneSide receiver_at) const {
    if (source_at == PlaneSide::kBehind || receiver.emits_only) return {};
    return {receiver_at != PlaneSide::kBehind,
            receiver_at != PlaneSide::kInFront && !source.emits_only && options_.antiradiance};
}

// Splits the larger end, or the other where it can't; false: neither can be split.
bool RefineOracle::split_larger(const GrowingNode& a, const GrowingNode& b, Verdict& v) const {
    const bool a_first = a.radius >= b.radius;
    const bool can_a = can_split(a);
    const bool can_b = can_split(b);
    if (!can_a && !can_b) return false;
    v.action = (a_first && can_a) || !can_b ? Verdict::kSplitA : Verdict::kSplitB;
    return true;
}

bool RefineOracle::can_split(const GrowingNode& n) const {
    return !n.is_leaf() || n.longest_edge > options_.least_edge;
}

// Both form factors below eps (a quarter of it where one end straddles the other's plane, since
// the form factor varies most there) and both solid angles below k bins.
inline bool RefineOracle::small_enough(const GrowingNode& a, const GrowingNode& b, const vec3& d,
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
    return solid_a * cos_b < eps && solid_b * cos_a < eps && solid_a < widest_ && solid_b < widest_;
}

bool RefineOracle::emits(const GrowingNode& patch) const {
    return tree_.surfaces()[static_cast<std::size_t>(patch.surface)].emits;
}

// Slivers and the small parts of a detailed model: what two of them exchange is less than what
// the oracle lets through between two patches of the least size, whatever their form factors
// (refinement by B F A, Hanrahan, Salzman & Aupperle 1991). Antiradiance needs the direction of
// every link, so that IMPLICIT can't do without the size of both ends.
// exchange: pi A F, m2; eps: pi times the threshold.
bool RefineOracle::negligible(float exchange, float smaller_area, float eps) const {
    return !options_.antiradiance && exchange < eps * least_area() &&
           exchange < kMostNegligible * eps * smaller_area;
}

// Touching ends have no form factor to go by, but 1 is the most.
bool RefineOracle::both_negligible(const GrowingNode& a, const GrowingNode& b) const {
    const float most = options_.link_threshold * least_area();
    return !options_.antiradiance && a.area < most && b.area < most;
}

inline Verdict RefineOracle::decide_clusters(const GrowingNode& a, const GrowingNode& b,
                                             bool whole) const {
    Verdict v;
    const bool a_receives = may_receive(a, b);
    const bool b_receives = may_receive(b, a);
    const bool lit = options_.antiradiance ? a_receives || b_receives : a_receives && b_receives;
    if (!lit || (a.emits_only && b.emits_only)) return v;

    if (options_.cluster_links && whole && !a.emits_only && !b.emits_only &&
        clusters_are_far(a, b)) {
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

// Of such a cluster the centre says little of which links cross the plane.
bool RefineOracle::may_be_cut_in_two(NodeId n) const {
    const auto i = static_cast<std::size_t>(n);
    return i < cut_in_two_.size() && cut_in_two_[i] != 0;
}

bool RefineOracle::clusters_are_far(const GrowingNode& a, const GrowingNode& b) const {
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

}  // namespace antiradiance
