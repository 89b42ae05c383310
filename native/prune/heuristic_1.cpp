// SPDX-License-Identifier: GPL-3.0-or-later
#include "prune/heuristic_1.h"

#include <algorithm>
#include <cmath>

#include "prune/for_each_bin.h"
#include "prune/node_table.h"

namespace antiradiance {

namespace {

// Between the axes of bins that touch, in radii of a bin: 1.9 on a regular grid of hexagons, where
// the next ring begins at 3.3.
constexpr float kTouchingRadii = 2.6F;

// Half the opening of the cone that spans a solid angle, rad.
float cone_radius(float solid_angle) {
    return std::acos(std::max(0.0F, 1 - solid_angle / (2 * kPi)));
}

float angle_between(const vec3& unit_a, const vec3& unit_b) {
    return std::acos(std::clamp(glm::dot(unit_a, unit_b), -1.0F, 1.0F));
}

struct FoundLink {
    LinkId link;
    SegmentId segment;
};

class Triples {
public:
    Triples(const PatchTree& tree, const LinkSet& links, PruneDirections directions,
            const KnownLinks& known)
        : tree_(tree),
          links_(links),
          directions_(directions),
          known_(known),
          bin_radius_(cone_radius(links.bins.mean_solid_angle())) {}

    // Removes links of this bin only, so that bins may run side by side.
    void mark_bin(int bin, RemovedLinks& removed) {
        bin_ = bin;
        load_minus();
        for (int b = 0; b < links_.bins.count(); ++b) {
            if (!may_lead_to(b)) continue;
            const auto i = static_cast<std::size_t>(b);
            for (SegmentId s = links_.bin_segments[i]; s < links_.bin_segments[i + 1]; ++s)
                mark_segment(s, removed);
        }
    }

private:
    void load_minus() {
        const auto bin = static_cast<std::size_t>(bin_);
        minus_.load(tree_.size(), [&](const auto& visit) {
            for (SegmentId s = links_.bin_segments[bin]; s < links_.bin_segments[bin + 1]; ++s) {
                for (LinkId l = links_.segments[s].begin; l < links_.segments[s].end; ++l) {
                    if (links_.links[l].form_factor < 0 && !is_gone(l))
                        visit(links_.links[l].source, FoundLink{l, s});
                }
            }
        });
    }

    // Whether a link in `bin` can be the one to the occluder.
    [[nodiscard]] bool may_lead_to(int bin) const {
        return bin == bin_ || (directions_ == PruneDirections::kText &&
                               angle_between(links_.bins.axis(bin), links_.bins.axis(bin_)) <
                                   kTouchingRadii * bin_radius_);
    }

    // All triples whose occluder is the receiver of this segment or a patch above it.
    void mark_segment(SegmentId lit, RemovedLinks& removed) {
        occluders_.clear();
        bool any = false;
        for (NodeId n = links_.segments[lit].receiver; n != kNone && !tree_.is_cluster(n);
             n = tree_.parent[static_cast<std::size_t>(n)]) {
            occluders_.push_back(n);
            any = any || !minus_.of(n).empty();
        }
        if (!any) return;
        for (LinkId l = links_.segments[lit].begin; l < links_.segments[lit].end; ++l) {
            if (links_.links[l].form_factor > 0 && !is_gone(l))
                mark_behind(links_.links[l].source, removed);
        }
    }

    void mark_behind(NodeId sender, RemovedLinks& removed) const {
        for (std::size_t i = 0; i < occluders_.size(); ++i) {
            if (minus_.of(occluders_[i]).empty()) continue;
            if (known_.visibility.empty() && !fills_bin(sender, i)) return;
            for (const FoundLink& from_occluder : minus_.of(occluders_[i])) {
                const LinkRange from_sender = links_from(links_, from_occluder.segment, sender);
                for (LinkId l = from_sender.first; l < from_sender.last; ++l) {
                    if (links_.links[l].form_factor > 0 && !is_gone(l) && is_blocked(l))
                        removed[l] = removed[from_occluder.link] = 1;
                }
            }
        }
    }

    [[nodiscard]] bool is_gone(LinkId l) const { return !known_.gone.empty() && known_.gone[l]; }
    [[nodiscard]] bool is_blocked(LinkId l) const {
        return known_.visibility.empty() || known_.visibility[l] == LinkVisibility::kNone;
    }

    // Lines 6 to 10 for occluder i and the patches above it.
    [[nodiscard]] bool fills_bin(NodeId sender, std::size_t i) const {
        const auto s = static_cast<std::size_t>(sender);
        return std::any_of(
            occluders_.begin() + static_cast<std::ptrdiff_t>(i), occluders_.end(), [&](NodeId n) {
                const auto o = static_cast<std::size_t>(n);
                const vec3 d = tree_.center[o] - tree_.center[s];
                const float d2 = glm::dot(d, d);
                const vec3 direction = d / std::sqrt(d2);
                const float cosine = std::abs(glm::dot(tree_.normal[o], direction));
                const float radius = cone_radius(tree_.area[o] * cosine / d2);
                return radius > bin_radius_ &&
                       angle_between(direction, links_.bins.axis(bin_)) + bin_radius_ <= radius;
            });
    }

    const PatchTree& tree_;
    const LinkSet& links_;
    PruneDirections directions_;
    KnownLinks known_;
    float bin_radius_;  // rad
    int bin_ = 0;
    NodeTable<FoundLink> minus_;     // of the bin, by their source
    std::vector<NodeId> occluders_;  // of the segment at hand, from its receiver upwards
};

}  // namespace

RemovedLinks find_blocked_triples(const PatchTree& tree, const LinkSet& links,
                                  PruneDirections directions, const KnownLinks& known,
                                  Progress& progress) {
    RemovedLinks removed(links.links.size(), 0);
    for_each_bin(
        links, progress, [&] { return Triples(tree, links, directions, known); },
        [&](Triples& triples, int bin) { triples.mark_bin(bin, removed); });
    return removed;
}

}  // namespace antiradiance
