// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/transport_input.h"

#include "hierarchy/patch_materials.h"

namespace antiradiance {

TransportInput make_transport_input(const Scene& scene, const PatchTree& tree,
                                    std::span<const vec3> direct, DirectLightMode mode) {
    const PatchMaterials materials = average_materials(scene, tree);
    TransportInput input;
    input.source.assign(tree.size(), vec3(0));
    for (const NodeId leaf : tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        input.source[n] = materials.albedo[n] * kInvPi * direct[n];
        if (mode == DirectLightMode::kImplicit) input.source[n] += materials.emission[n];
        input.source[n] *= tree.exposed[n];
    }
    input.albedo.resize(tree.size());
    for (std::size_t n = 0; n < tree.size(); ++n)
        input.albedo[n] = materials.albedo[n] * tree.exposed[n];
    return input;
}

}  // namespace antiradiance
