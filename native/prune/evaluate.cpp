// SPDX-License-Identifier: GPL-3.0-or-later
#include "prune/evaluate.h"

#include <algorithm>

namespace antiradiance {

RemovedLinks invisible_links(std::span<const LinkVisibility> visibility) {
    RemovedLinks invisible(visibility.size());
    std::transform(visibility.begin(), visibility.end(), invisible.begin(), [](LinkVisibility v) {
        return static_cast<std::uint8_t>(v == LinkVisibility::kNone);
    });
    return invisible;
}

PruneEvaluation evaluate_pruning(const PatchTree& tree, const LinkSet& links,
                                 std::span<const std::uint8_t> removed,
                                 std::span<const std::uint8_t> reference, double seconds) {
    PruneEvaluation e;
    e.patches = tree.leaves.size();
    e.links = links.links.size();
    e.seconds = seconds;
    for (std::size_t l = 0; l < links.links.size(); ++l) {
        const bool wrong = removed[l] && !reference[l];
        e.explicit_test += reference[l] ? 1 : 0;
        e.removed += removed[l] ? 1 : 0;
        e.incorrect += wrong ? 1 : 0;
        e.incorrect_radiance += wrong && links.links[l].form_factor > 0 ? 1 : 0;
        e.not_removed += reference[l] && !removed[l] ? 1 : 0;
    }
    return e;
}

}  // namespace antiradiance
