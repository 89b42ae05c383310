// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/patch_lights.h"

#include "base/random.h"
#include "links/visibility.h"

namespace antiradiance {

PatchLights::PatchLights(const PatchTree& tree, std::span<const vec3> radiance, int samples)
    : samples_(samples),
      lights_(tree.size()),
      points_(tree.size() * static_cast<std::size_t>(samples)) {
    const SurfaceSampler sampler(tree);
    for (std::size_t n = 0; n < tree.size(); ++n) {
        const auto id = static_cast<NodeId>(n);
        if (tree.is_cluster(id)) continue;
        lights_[n] = {tree.center[n], tree.radius[n], tree.normal[n], tree.area[n], radiance[n]};
        // By the place in its surface: a patch keeps its points when others come or go.
        const vec2 place = tree.region[n].corners[0];
        const std::uint32_t seed =
            hash_combine(static_cast<std::uint32_t>(tree.surface[n]),
                         hash_combine(static_cast<std::uint32_t>(place.x * 65536),
                                      static_cast<std::uint32_t>(place.y * 65536)));
        for (int i = 0; i < samples; ++i) {
            points_[n * static_cast<std::size_t>(samples) + static_cast<std::size_t>(i)] =
                sampler.sample(id, r2_sample(static_cast<std::uint32_t>(i), seed)).point;
        }
    }
}

}  // namespace antiradiance
