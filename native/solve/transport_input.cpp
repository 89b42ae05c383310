// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/transport_input.h"

namespace antiradiance {

TransportInput transport_input(const PatchTree& tree, std::span<const vec3> direct,
                               DirectLightMode mode) {
    TransportInput input{std::vector<vec3>(tree.size(), vec3(0)),
                         std::vector<vec3>(tree.size(), vec3(0))};
    for (const NodeId leaf : tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        input.albedo[n] = tree.albedo[n] * tree.exposed[n];
        input.source[n] = input.albedo[n] * kInvPi * direct[n];
        if (mode == DirectLightMode::kImplicit)
            input.source[n] += tree.emission[n] * tree.exposed[n];
    }
    return input;
}

}  // namespace antiradiance
