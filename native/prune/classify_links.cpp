// SPDX-License-Identifier: GPL-3.0-or-later
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "prune/link_visibility.h"
#include "prune/shaft.h"

namespace antiradiance {

namespace {

// A region that may block links to the receiver at hand.
struct Blocker {
    RegionId region;
    float height;     // m, of the receiver's centre above its plane
    bool sends_back;  // - links come from it: the receiver lies behind it
};

class Classifier {
public:
    Classifier(const PatchTree& tree, const LinkSet& links, const Blockers& blockers,
               const ClassifyOptions& options)
        : tree_(tree),
          links_(links),
          shapes_(blockers.shapes),
          regions_(blockers.regions),
          region_of_(blockers.region_of),
          options_(options),
          test_(blockers.regions),
          clusters_receive_(
              std::any_of(links.segments.begin(), links.segments.end(),
                          [&](const Segment& s) { return tree.is_cluster(s.receiver); })),
          seen_(blockers.regions.regions.size(), kAbsent) {}

    void classify_bin(int bin, std::vector<LinkVisibility>& result) {
        segments_.load(tree_, links_, bin);
        for (SegmentId s = segments_.begin(); s < segments_.end(); ++s) {
            load_receiver(s);
            for (LinkId l = links_.segments[s].begin; l < links_.segments[s].end; ++l)
                result[l] = classify(links_.links[l]);
        }
    }

private:
    [[nodiscard]] RegionId region_of(NodeId patch) const {
        return region_of_[static_cast<std::size_t>(patch)];
    }

    void load_receiver(SegmentId row) {
        row_ = row;
        receiver_ = links_.segments[row].receiver;
        center_ = tree_.center[static_cast<std::size_t>(receiver_)];
        corners_.clear();
        blockers_.clear();
        candidates_ = 0;
        for (NodeId up = receiver_; up != kNone && (clusters_receive_ || !tree_.is_cluster(up));
             up = tree_.parent[static_cast<std::size_t>(up)])
            add_candidates(segments_[up]);
        const NodeId end = tree_.subtree_end[static_cast<std::size_t>(receiver_)];
        for (NodeId child = receiver_ + 1; child < end;
             child = tree_.subtree_end[static_cast<std::size_t>(child)])
            add_candidates(segments_[child]);
    }

    void add_candidates(SegmentId row) {
        if (row == kAbsent) return;
        for (LinkId l = links_.segments[row].begin; l < links_.segments[row].end; ++l) {
            const Link& link = links_.links[l];
            if (!tree_.is_cluster(link.source)) {
                add_candidate(region_of(link.source), link.form_factor < 0);
                continue;
            }
            for (const NodeId member : shapes_.members(link.source))
                add_candidate(region_of(member), link.form_factor < 0);
        }
    }

    // Once a receiver, however many patches of the region it is linked with.
    void add_candidate(RegionId region, bool sends_back) {
        if (region == kNone) return;
        SegmentId& seen = seen_[static_cast<std::size_t>(region)];
        if (seen == row_) {
            if (sends_back) mark_sends_back(region);
            return;
        }
        seen = row_;
        ++candidates_;
        const float height = regions_.height(region, center_);
        if (std::abs(height) > regions_.tolerance)
            blockers_.push_back({region, height, sends_back});
    }

    void mark_sends_back(RegionId region) {
        for (Blocker& b : blockers_) {
            if (b.region == region) b.sends_back = true;
        }
    }

    LinkVisibility classify(const Link& link) {
        const bool facing =
            link.form_factor < 0 && options_.blocking_sides == BlockingSides::kFacing;
        bool others = false;
        bool blocked = true;
        for (const NodeId member : shapes_.members(link.source)) {
            const RegionId own = region_of(member);
            const bool own_is_candidate =
                own != kNone && seen_[static_cast<std::size_t>(own)] == row_;
            others = others || candidates_ > (own_is_candidate ? 1U : 0U);
            blocked = blocked && is_blocked(member, own, facing);
        }
        if (blocked) return LinkVisibility::kNone;
        return others ? LinkVisibility::kPartial : LinkVisibility::kFull;
    }

    // What has blocked a source often blocks the next, which is its neighbour: it goes first.
    bool is_blocked(NodeId source, RegionId own, bool facing) {
        for (Blocker& b : blockers_) {
            if (b.region == own || (facing && !b.sends_back) || !centers_cross(b, source) ||
                !blocks(b.region, source))
                continue;
            std::swap(blockers_[0], b);
            return true;
        }
        return false;
    }

    // Whether the segment between both centres passes through the region: few do.
    [[nodiscard]] bool centers_cross(const Blocker& b, NodeId source) const {
        const vec3& center = tree_.center[static_cast<std::size_t>(source)];
        const float height = regions_.height(b.region, center);
        if (height * b.height >= 0) return false;
        const float far = std::abs(height);
        const float near = std::abs(b.height);
        const vec4 crossing(far * center_ + near * center, far + near);
        const float least = -regions_.tolerance * (far + near);
        const std::span<const vec4> edges = regions_.edges_of(b.region);
        return std::all_of(edges.begin(), edges.end(),
                           [&](const vec4& edge) { return glm::dot(edge, crossing) >= least; });
    }

    bool blocks(RegionId region, NodeId source) {
        if (options_.shaft == Shaft::kFromCenter)
            return test_.blocks(region, {&center_, 1}, shapes_.corners(source));
        if (corners_.empty()) {
            for (const NodeId member : shapes_.members(receiver_)) {
                const auto corners = shapes_.corners(member);
                corners_.insert(corners_.end(), corners.begin(), corners.end());
            }
        }
        return test_.blocks(region, corners_, shapes_.corners(source));
    }

    const PatchTree& tree_;
    const LinkSet& links_;
    const NodeShapes& shapes_;
    const ConvexRegions& regions_;
    const std::vector<RegionId>& region_of_;
    ClassifyOptions options_;
    ShaftTest test_;
    bool clusters_receive_;
    BinSegments segments_;
    // Of the receiver at hand:
    SegmentId row_ = kAbsent;
    NodeId receiver_ = kNone;
    vec3 center_{0};
    std::vector<vec3> corners_;    // filled when first asked for
    std::vector<SegmentId> seen_;  // #regions: the segment that it was last a candidate for
    std::size_t candidates_ = 0;   // regions, and of those the ones that can block:
    std::vector<Blocker> blockers_;
};

}  // namespace

Blockers::Blockers(const Scene& scene, const PatchTree& tree)
    : shapes(tree),
      regions(find_convex_regions(scene, tree.surfaces)),
      region_of(tree.size(), kNone) {
    for (std::size_t n = 0; n < tree.size(); ++n) {
        if (tree.surface[n] != kNone)
            region_of[n] = regions.of_surface[static_cast<std::size_t>(tree.surface[n])];
    }
}

std::vector<LinkVisibility> classify_links(const PatchTree& tree, const LinkSet& links,
                                           const Blockers& blockers, const ClassifyOptions& options,
                                           Progress& progress) {
    std::vector<LinkVisibility> result(links.links.size(), LinkVisibility::kFull);
    tbb::enumerable_thread_specific<Classifier> classifiers(
        [&] { return Classifier(tree, links, blockers, options); });
    parallel_for(static_cast<std::size_t>(links.bins.count()), progress, [&](std::size_t bin) {
        classifiers.local().classify_bin(static_cast<int>(bin), result);
    });
    return result;
}

}  // namespace antiradiance
