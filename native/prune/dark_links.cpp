// SPDX-License-Identifier: GPL-3.0-or-later
#include "prune/dark_links.h"

#include <algorithm>
#include <vector>

namespace antiradiance {

namespace {

// Whether any leaf below a node has a property.
class AnyLeaf {
public:
    template <typename Holds>
    AnyLeaf(const PatchTree& tree, const Holds& holds) : tree_(tree), before_(tree.size() + 1, 0) {
        for (std::size_t n = 0; n < tree.size(); ++n)
            before_[n + 1] =
                before_[n] + (tree.is_leaf(static_cast<NodeId>(n)) && holds(n) ? 1 : 0);
    }
    [[nodiscard]] bool below(NodeId n) const {
        const auto i = static_cast<std::size_t>(n);
        return before_[static_cast<std::size_t>(tree_.subtree_end[i])] > before_[i];
    }

private:
    const PatchTree& tree_;
    std::vector<std::uint32_t> before_;  // #nodes + 1: leaves with the property before the node
};

}  // namespace

RemovedLinks find_dark_links(const PatchTree& tree, const LinkSet& links,
                             std::span<const vec3> source, std::span<const vec3> albedo,
                             Progress& progress) {
    std::vector<std::uint8_t> receives(tree.size(), 0);
    const auto sends_light = [&](std::size_t leaf) {
        return max_component(source[leaf]) > 0 ||
               (receives[leaf] && max_component(albedo[leaf]) > 0);
    };
    // One bounce further each time.
    for (bool changed = true; changed;) {
        progress.check();
        changed = false;
        const AnyLeaf lit(tree, sends_light);
        for (const Segment& s : links.segments) {
            std::uint8_t& receiver = receives[static_cast<std::size_t>(s.receiver)];
            if (receiver) continue;
            receiver = std::any_of(
                links.links.begin() + s.begin, links.links.begin() + s.end,
                [&](const Link& l) { return l.form_factor > 0 && lit.below(l.source); });
            changed = changed || receiver;
        }
        for (std::size_t n = 1; n < tree.size(); ++n)
            receives[n] |= receives[static_cast<std::size_t>(tree.parent[n])];
    }

    const AnyLeaf lit(tree, sends_light);
    const AnyLeaf passing(tree, [&](std::size_t leaf) { return receives[leaf] != 0; });
    RemovedLinks removed(links.links.size());
    std::transform(links.links.begin(), links.links.end(), removed.begin(), [&](const Link& l) {
        return static_cast<std::uint8_t>(!(l.form_factor > 0 ? lit : passing).below(l.source));
    });
    return removed;
}

}  // namespace antiradiance
