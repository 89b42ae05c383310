// SPDX-License-Identifier: GPL-3.0-or-later
#include "hierarchy/coverage.h"

#include <algorithm>
#include <bit>
#include <map>

#include "base/parallel.h"
#include "base/random.h"
#include "hierarchy/push_pull.h"

namespace antiradiance {

namespace {

constexpr int kStrata = 4;               // along each side of a patch
constexpr int kRays = 4;                 // per point that looks buried
constexpr int kBuriedHits = 3;           // of kRays on unlit sides
constexpr float kWorthAWarning = 0.02F;  // of an object's area

class BurialTest {
public:
    BurialTest(const RayScene& rays, const PatchTree& tree) : rays_(rays), tree_(tree) {}

    [[nodiscard]] std::uint16_t exposed_mask(NodeId leaf) const {
        std::uint16_t mask = 0;
        for (std::uint32_t k = 0; k < kStrata * kStrata; ++k) {
            if (!is_buried(leaf, k)) mask = static_cast<std::uint16_t>(mask | (1U << k));
        }
        return mask;
    }

private:
    [[nodiscard]] bool is_buried(NodeId leaf, std::uint32_t stratum) const {
        const auto n = static_cast<std::size_t>(leaf);
        const vec2 cell(static_cast<float>(stratum % kStrata),
                        static_cast<float>(stratum / kStrata));
        const vec3 normal = tree_.normal[n];
        const vec3 point = tree_.patch_point(leaf, (cell + 0.5F) / static_cast<float>(kStrata)) +
                           normal * (4 * rays_.epsilon());
        const Frame frame(normal);
        const std::uint32_t seed = static_cast<std::uint32_t>(leaf) * 16 + stratum;
        int unlit = 0;
        for (int i = 0; i < kRays; ++i) {
            const vec2 u = r2_sample(static_cast<std::uint32_t>(i), seed);
            const RayHit hit = rays_.intersect(point, frame.to_world(cosine_hemisphere(u)));
            const bool on_unlit_side =
                hit.hit() && tree_.triangle_surface[static_cast<std::size_t>(hit.triangle)]
                                                   [hit.back_side ? 1 : 0] == kNone;
            if (on_unlit_side) ++unlit;
            // Most points are in the open: one ray settles those.
            if (i == 0 && !on_unlit_side) return false;
        }
        return unlit >= kBuriedHits;
    }

    const RayScene& rays_;
    const PatchTree& tree_;
};

// Objects whose surfaces are buried, with the share of their lit area.
std::vector<std::string> burial_warnings(const Scene& scene, const PatchTree& tree) {
    std::map<std::int32_t, vec2> area;  // object -> buried, all
    for (const NodeId leaf : tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        const Surface& s = tree.surfaces[static_cast<std::size_t>(tree.surface[n])];
        if (s.object == kNone) continue;
        area[s.object] += vec2(tree.area[n] * (1 - tree.exposed[n]), tree.area[n]);
    }
    std::vector<std::string> names;
    for (const auto& [object, a] : area) {
        if (a.x > kWorthAWarning * a.y)
            names.push_back(scene.objects[static_cast<std::size_t>(object)].name);
    }
    if (names.empty()) return {};
    constexpr std::size_t kMostNames = 8;
    std::string list;
    for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i) {
        list += (i ? ", '" : "'") + names[i] + "'";
    }
    if (names.size() > kMostNames)
        list += " and " + std::to_string(names.size() - kMostNames) + " more";
    return {"Parts of these objects lie inside of other solids and take no part in the light: " +
            list + ". Cut the surfaces where the objects meet for the best result"};
}

}  // namespace

std::vector<std::string> find_buried_patches(const Scene& scene, const RayScene& rays,
                                             PatchTree& tree, Progress& progress) {
    const BurialTest test(rays, tree);
    parallel_for_blocks(tree.leaves.size(), 64, progress, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const NodeId leaf = tree.leaves[i];
            if (tree.emits_only(leaf)) continue;
            const std::uint16_t mask = test.exposed_mask(leaf);
            tree.exposed_mask[static_cast<std::size_t>(leaf)] = mask;
            tree.exposed[static_cast<std::size_t>(leaf)] =
                static_cast<float>(std::popcount(mask)) / 16;
        }
    });
    pull_area_average<float>(tree, tree.exposed);
    return burial_warnings(scene, tree);
}

}  // namespace antiradiance
