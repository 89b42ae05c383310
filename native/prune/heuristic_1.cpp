// SPDX-License-Identifier: GPL-3.0-or-later
#include "prune/heuristic_1.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

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

// - links of one bin by their source.
class MinusLinks {
public:
    struct Entry {
        LinkId link;
        SegmentId segment;
    };

    void load(const LinkSet& links, SegmentId begin, SegmentId end, const KnownLinks& known,
              std::size_t node_count) {
        first_.assign(node_count + 1, 0);
        const auto for_each = [&](const auto& visit) {
            for (SegmentId s = begin; s < end; ++s) {
                for (LinkId l = links.segments[s].begin; l < links.segments[s].end; ++l) {
                    if (links.links[l].form_factor < 0 && (known.gone.empty() || !known.gone[l]))
                        visit(static_cast<std::size_t>(links.links[l].source), Entry{l, s});
                }
            }
        };
        for_each([&](std::size_t source, const Entry&) { ++first_[source + 1]; });
        for (std::size_t n = 0; n < node_count; ++n)
            first_[n + 1] += first_[n];
        entries_.resize(first_.back());
        fill_.assign(first_.begin(), first_.end() - 1);
        for_each([&](std::size_t source, const Entry& e) { entries_[fill_[source]++] = e; });
    }

    [[nodiscard]] std::span<const Entry> from(NodeId source) const {
        const auto n = static_cast<std::size_t>(source);
        return std::span(entries_).subspan(first_[n], first_[n + 1] - first_[n]);
    }

private:
    std::vector<std::uint32_t> first_, fill_;  // #nodes
    std::vector<Entry> entries_;
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
        const SegmentId begin = links_.bin_segments[static_cast<std::size_t>(bin)];
        const SegmentId end = links_.bin_segments[static_cast<std::size_t>(bin) + 1];
        minus_.load(links_, begin, end, known_, tree_.size());
        for (int b = 0; b < links_.bins.count(); ++b) {
            if (!may_lead_to(b)) continue;
            const auto i = static_cast<std::size_t>(b);
            for (SegmentId s = links_.bin_segments[i]; s < links_.bin_segments[i + 1]; ++s)
                mark_segment(s, removed);
        }
    }

private:
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
            any = any || !minus_.from(n).empty();
        }
        if (!any) return;
        for (LinkId l = links_.segments[lit].begin; l < links_.segments[lit].end; ++l) {
            if (links_.links[l].form_factor > 0 && !is_gone(l))
                mark_behind(links_.links[l].source, removed);
        }
    }

    void mark_behind(NodeId sender, RemovedLinks& removed) const {
        for (std::size_t i = 0; i < occluders_.size(); ++i) {
            if (minus_.from(occluders_[i]).empty()) continue;
            if (known_.visibility.empty() && !fills_bin(sender, i)) return;
            for (const MinusLinks::Entry& from_occluder : minus_.from(occluders_[i])) {
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
    MinusLinks minus_;
    std::vector<NodeId> occluders_;  // of the segment at hand, from its receiver upwards
};

}  // namespace

RemovedLinks find_blocked_triples(const PatchTree& tree, const LinkSet& links,
                                  PruneDirections directions, const KnownLinks& known,
                                  Progress& progress) {
    RemovedLinks removed(links.links.size(), 0);
    tbb::enumerable_thread_specific<Triples> triples(
        [&] { return Triples(tree, links, directions, known); });
    parallel_for(static_cast<std::size_t>(links.bins.count()), progress, [&](std::size_t bin) {
        triples.local().mark_bin(static_cast<int>(bin), removed);
    });
    return removed;
}

}  // namespace antiradiance
