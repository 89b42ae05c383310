// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "hierarchy/shaft.h"
#include "prune/for_each_bin.h"
#include "prune/link_visibility.h"

namespace antiradiance {

namespace {

class Classifier {
public:
    Classifier(const PatchTree& tree, const LinkSet& links, const Blockers& blockers,
               const ClassifyOptions& options)
        : tree_(tree),
          links_(links),
          blocking_(blockers),
          regions_(blockers.regions),
          options_(options),
          test_(blockers.regions),
          is_candidate_(2 * blockers.regions.regions.size(), 0) {}

    // Receivers in preorder: the candidates of those above the one at hand are on a stack.
    void classify_bin(int bin, std::vector<LinkVisibility>& result) {
        segments_.load(tree_, links_, bin);
        if (segments_.begin() == segments_.end()) return;
        for (NodeId n = 0; n < static_cast<NodeId>(tree_.size()); ++n) {
            if (segments_[n] == kAbsent) continue;
            while (!above_.empty() && above_.back().end <= n)
                pop_receiver();
            above_.push_back({tree_.subtree_end[static_cast<std::size_t>(n)], candidates_.size()});
            add_candidates(segments_[n]);
            classify_segment(segments_[n], result);
        }
        while (!above_.empty())
            pop_receiver();
    }

private:
    // A region that may block links to the receiver at hand.
    struct Candidate {
        RegionId region;
        bool sends_back;  // - links come from it: the receiver lies behind it; if that matters
    };
    struct Blocker {
        vec3 normal;  // of its plane
        float offset;
        float height;  // m, of the receiver's centre above its plane
        Candidate is;
    };
    struct Receiver {
        NodeId end;              // of its subtree
        std::size_t candidates;  // before its own
    };

    void add_candidates(SegmentId row) {
        if (row == kAbsent) return;
        for (LinkId l = links_.segments[row].begin; l < links_.segments[row].end; ++l) {
            const Link& link = links_.links[l];
            const bool sends_back =
                options_.blocking_sides == BlockingSides::kFacing && link.form_factor < 0;
            const RegionId region = blocking_.places[static_cast<std::size_t>(link.source)].region;
            if (region != kRegionsOfMembers) {
                add_candidate({region, sends_back});
                continue;
            }
            for (const NodeId member : blocking_.shapes.members(link.source))
                add_candidate({region_of(member), sends_back});
        }
    }
    void add_candidate(const Candidate& c) {
        if (c.region == kNone || is_candidate(c)) return;
        is_candidate(c) = 1;
        candidates_.push_back(c);
    }
    void drop_candidates(std::size_t count) {
        for (std::size_t i = count; i < candidates_.size(); ++i)
            is_candidate(candidates_[i]) = 0;
        candidates_.resize(count);
    }
    [[nodiscard]] std::uint8_t& is_candidate(const Candidate& c) {
        return is_candidate_[2 * static_cast<std::size_t>(c.region) + (c.sends_back ? 1 : 0)];
    }
    void pop_receiver() {
        drop_candidates(above_.back().candidates);
        above_.pop_back();
    }

    void classify_segment(SegmentId row, std::vector<LinkVisibility>& result) {
        receiver_ = links_.segments[row].receiver;
        const std::size_t without_children = candidates_.size();
        const NodeId end = tree_.subtree_end[static_cast<std::size_t>(receiver_)];
        for (NodeId child = receiver_ + 1; child < end;
             child = tree_.subtree_end[static_cast<std::size_t>(child)])
            add_candidates(segments_[child]);
        load_blockers();
        for (LinkId l = links_.segments[row].begin; l < links_.segments[row].end; ++l)
            result[l] = classify(links_.links[l]);
        drop_candidates(without_children);
    }

    // What has blocked a link often blocks the next, whose ends are neighbours: it goes first.
    void load_blockers() {
        center_ = tree_.center[static_cast<std::size_t>(receiver_)];
        corners_.clear();
        blockers_.clear();
        for (const Candidate& c : candidates_) {
            const ConvexRegion& region = regions_.regions[static_cast<std::size_t>(c.region)];
            const float height = glm::dot(region.normal, center_) - region.offset;
            if (std::abs(height) <= regions_.tolerance) continue;
            blockers_.push_back({region.normal, region.offset, height, c});
            if (c.region == last_) std::swap(blockers_.front(), blockers_.back());
        }
    }

    LinkVisibility classify(const Link& link) {
        const bool facing =
            link.form_factor < 0 && options_.blocking_sides == BlockingSides::kFacing;
        const RegionId own = region_of(link.source);
        bool blocked = true;
        bool others = false;
        if (own != kRegionsOfMembers) {
            blocked = is_blocked(link.source, facing);
            others = !blocked && any_candidate_but(own);
        } else {
            for (const NodeId member : blocking_.shapes.members(link.source)) {
                blocked = blocked && is_blocked(member, facing);
                others = others || any_candidate_but(region_of(member));
            }
        }
        if (blocked) return LinkVisibility::kNone;
        return others ? LinkVisibility::kPartial : LinkVisibility::kFull;
    }
    [[nodiscard]] bool any_candidate_but(RegionId own) const {
        return std::any_of(candidates_.begin(), candidates_.end(),
                           [&](const Candidate& c) { return c.region != own; });
    }
    [[nodiscard]] RegionId region_of(NodeId n) const {
        return blocking_.places[static_cast<std::size_t>(n)].region;
    }

    bool is_blocked(NodeId source, bool facing) {
        const Blockers::Place& place = blocking_.places[static_cast<std::size_t>(source)];
        for (Blocker& b : blockers_) {
            const float height = glm::dot(b.normal, place.center) - b.offset;
            if (height * b.height >= 0 || b.is.region == place.region ||
                (facing && !b.is.sends_back) || !centers_cross(b, place.center, height) ||
                !blocks(b.is.region, source))
                continue;
            last_ = b.is.region;
            std::swap(blockers_.front(), b);
            return true;
        }
        return false;
    }

    // Whether the segment between both centres passes through the region: few do.
    [[nodiscard]] bool centers_cross(const Blocker& b, const vec3& center, float height) const {
        const float far = std::abs(height);
        const float near = std::abs(b.height);
        const vec4 crossing(far * center_ + near * center, far + near);
        const float least = -regions_.tolerance * (far + near);
        const std::span<const vec4> edges = regions_.edges_of(b.is.region);
        return std::all_of(edges.begin(), edges.end(),
                           [&](const vec4& edge) { return glm::dot(edge, crossing) >= least; });
    }

    bool blocks(RegionId region, NodeId source) {
        if (options_.shaft == Shaft::kFromCenter)
            return test_.blocks(region, {&center_, 1}, blocking_.shapes.corners(source));
        if (corners_.empty()) {
            for (const NodeId member : blocking_.shapes.members(receiver_)) {
                const auto corners = blocking_.shapes.corners(member);
                corners_.insert(corners_.end(), corners.begin(), corners.end());
            }
        }
        return test_.blocks(region, corners_, blocking_.shapes.corners(source));
    }

    const PatchTree& tree_;
    const LinkSet& links_;
    const Blockers& blocking_;
    const ConvexRegions& regions_;
    ClassifyOptions options_;
    ShaftTest test_;
    BinSegments segments_;
    std::vector<Receiver> above_;  // the receiver at hand and those above it
    std::vector<Candidate> candidates_;
    std::vector<std::uint8_t> is_candidate_;  // #regions x 2: by sends_back
    RegionId last_ = kNone;                   // that blocked a link
    // Of the receiver at hand:
    NodeId receiver_ = kNone;
    vec3 center_{0};
    std::vector<vec3> corners_;  // filled when first asked for
    std::vector<Blocker> blockers_;
};

}  // namespace

Blockers::Blockers(const Scene& scene, const PatchTree& tree)
    : shapes(tree), regions(find_convex_regions(scene, tree.surfaces)) {
    for (std::size_t n = 0; n < tree.size(); ++n) {
        const SurfaceId surface = tree.surface[n];
        places.push_back(
            {tree.center[n], surface == kNone
                                 ? kRegionsOfMembers
                                 : regions.of_surface[static_cast<std::size_t>(surface)]});
    }
}

std::vector<LinkVisibility> classify_links(const PatchTree& tree, const LinkSet& links,
                                           const Blockers& blockers, const ClassifyOptions& options,
                                           Progress& progress) {
    std::vector<LinkVisibility> result(links.links.size(), LinkVisibility::kFull);
    for_each_bin(
        links, progress, [&] { return Classifier(tree, links, blockers, options); },
        [&](Classifier& classifier, int bin) { classifier.classify_bin(bin, result); });
    return result;
}

}  // namespace antiradiance
