// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/source_lists.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"

namespace antiradiance {

namespace {

constexpr float kNear = 2;       // radii of a node within which it is refined
constexpr float kNotShared = 4;  // and within which it lights every pixel of an interleaved block

// Whether a sphere lies wholly behind all planes whose normals are within a cone about `axis`.
// d: m, from the planes to the sphere's centre; reach: m, its radius and that of the planes'
// places.
bool is_behind(const vec3& axis, float cone_cosine, const vec3& d, float reach) {
    if (cone_cosine <= 0) return false;
    const float distance = glm::length(d);
    if (distance <= reach) return false;
    // angle - cone - asin(reach / distance) >= 90 degrees, without the angles.
    const float cosine = glm::dot(d, axis) / distance;
    if (cosine > 0) return false;
    const float sine_cone = std::sqrt(std::max(0.0F, 1 - cone_cosine * cone_cosine));
    const float sine_reach = reach / distance;
    const float cosine_reach = std::sqrt(1 - sine_reach * sine_reach);
    if (cone_cosine * cosine_reach <= sine_cone * sine_reach) return false;
    // -cosine = sin(angle - 90 deg) against sin(cone + reach), both angles below 90 degrees.
    return -cosine >= sine_cone * cosine_reach + cone_cosine * sine_reach;
}

class Cut {
public:
    Cut(const PatchTree& tree, const CutRule& rule) : tree_(tree), rule_(rule) {}

    // Appends the cut below `from` as seen from a group.
    void descend(NodeId from, const FragmentGroup& group, std::vector<NodeId>& out) const {
        const NodeId stop = tree_.subtree_end[static_cast<std::size_t>(from)];
        for (NodeId n = from; n < stop;) {
            const NodeId next = tree_.subtree_end[static_cast<std::size_t>(n)];
            if (below_horizon(n, group) || (rule_.fronts_only && faces_away(n, group))) {
                n = next;
            } else if (tree_.is_leaf(n) || is_small(n, group)) {
                out.push_back(n);
                n = next;
            } else {
                ++n;  // its first child
            }
        }
    }

private:
    // Whether no point of the node can lie above any fragment's horizon.
    [[nodiscard]] bool below_horizon(NodeId node, const FragmentGroup& group) const {
        const auto n = static_cast<std::size_t>(node);
        return is_behind(group.normal, group.cone_cosine, tree_.center[n] - group.center,
                         group.radius + tree_.radius[n]);
    }

    // Whether the group lies behind all surfaces of the node.
    [[nodiscard]] bool faces_away(NodeId node, const FragmentGroup& group) const {
        const auto n = static_cast<std::size_t>(node);
        const float extent = tree_.is_cluster(node) ? tree_.radius[n] : 0;
        return is_behind(tree_.normal[n], tree_.cone_cosine[n], group.center - tree_.center[n],
                         group.radius + extent);
    }

    [[nodiscard]] bool is_small(NodeId node, const FragmentGroup& group) const {
        const auto n = static_cast<std::size_t>(node);
        const vec3 d = group.center - tree_.center[n];
        const float distance = glm::length(d) - group.radius;
        if (distance <= kNear * tree_.radius[n]) return false;
        if (tree_.is_cluster(node))
            return kPi * tree_.radius[n] * tree_.radius[n] < rule_.threshold * distance * distance;
        const float height = std::abs(glm::dot(d, tree_.normal[n])) + group.radius;
        const float cosine = std::min(1.0F, height / distance);
        return tree_.area[n] * cosine < rule_.threshold * distance * distance;
    }

    const PatchTree& tree_;
    CutRule rule_;
};

bool stops(const PatchTree& tree, NodeId n, ShootingLevel level) {
    if (tree.is_cluster(n)) return false;
    if (tree.is_leaf(n)) return true;
    return level == ShootingLevel::kParents && tree.is_leaf(n + 1);
}

void append_level(const PatchTree& tree, NodeId from, ShootingLevel level,
                  std::vector<NodeId>& out) {
    const NodeId stop = tree.subtree_end[static_cast<std::size_t>(from)];
    for (NodeId n = from; n < stop;) {
        const bool take = stops(tree, n, level);
        if (take) out.push_back(n);
        n = take ? tree.subtree_end[static_cast<std::size_t>(n)] : n + 1;
    }
}

// Which segments end at a node.
class SegmentsByReceiver {
public:
    SegmentsByReceiver(const PatchTree& tree, const LinkSet& links)
        : begin_(tree.size() + 1, 0), segments_(links.segments.size()) {
        for (const Segment& s : links.segments)
            ++begin_[static_cast<std::size_t>(s.receiver) + 1];
        for (std::size_t n = 0; n < tree.size(); ++n)
            begin_[n + 1] += begin_[n];
        std::vector<std::uint32_t> fill(begin_.begin(), begin_.end() - 1);
        for (std::uint32_t i = 0; i < segments_.size(); ++i)
            segments_[fill[static_cast<std::size_t>(links.segments[i].receiver)]++] = i;
    }

    // Into LinkSet::segments.
    [[nodiscard]] std::span<const std::uint32_t> of(NodeId node) const {
        const auto n = static_cast<std::size_t>(node);
        return {segments_.data() + begin_[n], begin_[n + 1] - begin_[n]};
    }

private:
    std::vector<std::uint32_t> begin_;     // #nodes + 1, into segments_
    std::vector<std::uint32_t> segments_;  // into LinkSet::segments, by receiver
};

// The nodes that links connect to a leaf or its ancestors, without those below another one of them:
// a source may be linked in several bins, and below another one. Ascending; none for leaf kNone.
std::vector<NodeId> linked_nodes(const PatchTree& tree, const LinkSet& links,
                                 const SegmentsByReceiver& segments, NodeId leaf) {
    std::vector<NodeId> linked;
    for (NodeId n = leaf; n != kNone; n = tree.parent[static_cast<std::size_t>(n)]) {
        for (const std::uint32_t i : segments.of(n)) {
            const Segment& s = links.segments[i];
            for (std::uint32_t l = s.begin; l < s.end; ++l)
                linked.push_back(links.links[l].source);
        }
    }
    std::sort(linked.begin(), linked.end());
    std::vector<NodeId> topmost;
    for (const NodeId n : linked) {
        const bool below =
            !topmost.empty() && n < tree.subtree_end[static_cast<std::size_t>(topmost.back())];
        if (!below) topmost.push_back(n);
    }
    return topmost;
}

// The leaf that all fragments of a group lie on.
NodeId receiver_of(const GBuffer& buffer, const FragmentGroups& groups, std::size_t group) {
    return buffer.fragments[groups.order[groups.groups[group].begin]].leaf;
}

}  // namespace

SourceLists collect_lists(std::size_t group_count, Progress& progress,
                          const std::function<void(std::size_t, std::vector<NodeId>&)>& select) {
    constexpr std::size_t kBlock = 16;
    std::vector<std::vector<NodeId>> blocks((group_count + kBlock - 1) / kBlock);
    SourceLists lists;
    lists.begin.resize(group_count);
    lists.end.resize(group_count);
    parallel_for_blocks(group_count, kBlock, progress, [&](std::size_t begin, std::size_t end) {
        std::vector<NodeId>& list = blocks[begin / kBlock];
        for (std::size_t g = begin; g < end; ++g) {
            progress.check();
            lists.begin[g] = static_cast<std::uint32_t>(list.size());
            select(g, list);
            lists.end[g] = static_cast<std::uint32_t>(list.size());
        }
    });
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (lists.sources.size() + blocks[b].size() > std::numeric_limits<std::uint32_t>::max()) {
            throw SceneError(
                "Final shooting needs more than 4 billion pairs of patches: set Shooting Level to "
                "Cut, or lower the resolution");
        }
        const auto offset = static_cast<std::uint32_t>(lists.sources.size());
        for (std::size_t g = b * kBlock; g < std::min(group_count, (b + 1) * kBlock); ++g) {
            lists.begin[g] += offset;
            lists.end[g] += offset;
        }
        lists.sources.insert(lists.sources.end(), blocks[b].begin(), blocks[b].end());
        blocks[b] = {};
    }
    return lists;
}

SourceLists all_sources(const PatchTree& tree, ShootingLevel level, std::size_t group_count) {
    SourceLists lists;
    lists.shared = true;
    append_level(tree, 0, level, lists.sources);
    lists.begin.assign(group_count, 0);
    lists.end.assign(group_count, static_cast<std::uint32_t>(lists.sources.size()));
    return lists;
}

SourceLists cut_sources(const PatchTree& tree, const FragmentGroups& groups, const CutRule& rule,
                        Progress& progress) {
    const Cut cut(tree, rule);
    return collect_lists(
        groups.groups.size(), progress,
        [&](std::size_t g, std::vector<NodeId>& list) { cut.descend(0, groups.groups[g], list); });
}

SourceLists linked_sources(const PatchTree& tree, const LinkSet& links, const GBuffer& buffer,
                           const FragmentGroups& groups, ShootingLevel level, const CutRule& rule,
                           Progress& progress) {
    const SegmentsByReceiver segments(tree, links);
    const Cut cut(tree, rule);
    const auto select = [&](std::size_t g, std::vector<NodeId>& list) {
        const FragmentGroup& group = groups.groups[g];
        const NodeId receiver = receiver_of(buffer, groups, g);
        for (const NodeId source : linked_nodes(tree, links, segments, receiver)) {
            if (level == ShootingLevel::kCut) {
                cut.descend(source, group, list);
            } else {
                append_level(tree, source, level, list);
            }
        }
    };
    return collect_lists(groups.groups.size(), progress, select);
}

SourceLists uncut_sources(const PatchTree& tree, const BlockingPlanes& planes,
                          const GBuffer& buffer, const FragmentGroups& groups,
                          const SourceLists& lists, Progress& progress) {
    std::vector<std::uint8_t> cut_in_two(tree.size());
    for (std::size_t n = 0; n < tree.size(); ++n)
        cut_in_two[n] =
            tree.is_cluster(static_cast<NodeId>(n)) && planes.near(tree.center[n], tree.radius[n]);
    const auto select = [&](std::size_t g, std::vector<NodeId>& list) {
        const NodeId receiver = receiver_of(buffer, groups, g);
        const vec3& to = tree.center[static_cast<std::size_t>(receiver)];
        const auto append = [&](const auto& self, NodeId source) -> void {
            const auto n = static_cast<std::size_t>(source);
            if (cut_in_two[n]) {
                for (NodeId child = source + 1; child < tree.subtree_end[n];
                     child = tree.subtree_end[static_cast<std::size_t>(child)])
                    self(self, child);
            } else if (planes.crossed(tree.center[n], to) == kNone) {
                list.push_back(source);
            }
        };
        for (const NodeId source : lists.of(g))
            append(append, source);
    };
    return collect_lists(groups.groups.size(), progress, select);
}

NearAndFar split_near(const PatchTree& tree, const FragmentGroups& groups, const SourceLists& lists,
                      Progress& progress) {
    const auto is_near = [&](NodeId source, const FragmentGroup& group) {
        const auto n = static_cast<std::size_t>(source);
        const float reach = kNotShared * tree.radius[n] + group.radius;
        const vec3 d = tree.center[n] - group.center;
        return glm::dot(d, d) < reach * reach;
    };
    const auto part = [&](bool near) {
        const auto select = [&](std::size_t g, std::vector<NodeId>& list) {
            std::ranges::copy_if(lists.of(g), std::back_inserter(list), [&](NodeId source) {
                return is_near(source, groups.groups[g]) == near;
            });
        };
        return collect_lists(groups.groups.size(), progress, select);
    };
    return {part(true), part(false)};
}

}  // namespace antiradiance
