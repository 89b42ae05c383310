// SPDX-License-Identifier: GPL-3.0-or-later
// What pruning does to the solution.
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/lit_scene.h"
#include "pipeline/solution_error.h"
#include "prune/dark_links.h"
#include "prune/prune.h"
#include "support/scenes.h"

namespace antiradiance {
namespace {

Options implicit_options(float patch_size) {
    Options options;
    options.visibility = Visibility::kImplicit;
    options.max_patch_size = patch_size;
    return options;
}

struct Pruned : test::LitScene {
    using LitScene::LitScene;

    [[nodiscard]] PruneResult prune(const PruneOptions& options) const {
        Progress progress;
        return prune_links({scene, model.tree, model.links, model.rays}, options, progress);
    }
    [[nodiscard]] std::vector<vec3> irradiance(const LinkSet& links) const {
        Progress progress;
        return make_cpu_solver()
            ->solve({model.tree, links, input.source, input.albedo, model.row_scale}, {}, progress)
            .irradiance;
    }
    // Mean difference of the indirect irradiance, relative to the mean.
    [[nodiscard]] double error(const LinkSet& links, const std::vector<vec3>& expected) const {
        const std::vector<vec3> found = irradiance(links);
        double difference = 0;
        double all = 0;
        for (const NodeId leaf : model.tree.leaves) {
            const auto n = static_cast<std::size_t>(leaf);
            const double area = static_cast<double>(model.tree.area[n]) * model.tree.exposed[n];
            difference += area * std::abs(found[n].x - expected[n].x);
            all += area * expected[n].x;
        }
        return difference / all;
    }
};

TEST(Pruning, ConservativeAddsNoErrorToSpeakOf) {
    struct Case {
        const char* name;
        Scene scene;
        float patch_size;
        double removed;  // of all links, at least
    };
    for (const Case& c :
         {Case{"office", test::office(), 0.5F, 0.01}, Case{"corridor", test::corridor(), 0.5F, 0.1},
          Case{"boxes", test::floating_boxes(2), 0.4F, 0.005}}) {
        SCOPED_TRACE(c.name);
        const Pruned lit(c.scene, implicit_options(c.patch_size));
        Progress progress;
        const std::vector<vec3> expected =
            lit.irradiance(explicit_links(lit.model, {16}, progress).links);
        const PruneResult pruned = lit.prune({.method = PruneMethod::kConservative});
        const auto gone =
            static_cast<double>(pruned.removed_radiance + pruned.removed_antiradiance);
        EXPECT_GE(gone, c.removed * static_cast<double>(lit.model.links.links.size()));
        // algorithm.md "Honest targets": full + .01.
        EXPECT_LE(lit.error(pruned.links, expected), lit.error(lit.model.links, expected) + 0.01);
    }
}

TEST(Pruning, DarkLinksCarryNothing) {
    const Pruned lit(test::office(), implicit_options(0.8F));
    const PruneResult pruned = lit.prune({.method = PruneMethod::kHeuristic2});
    Progress progress;
    const RemovedLinks dark =
        find_dark_links(lit.model.tree, pruned.links, lit.input.source, lit.input.albedo, progress);
    const LinkSet left = remove_links(pruned.links, dark);
    EXPECT_LT(left.links.size(), pruned.links.links.size());
    const std::vector<vec3> before = lit.irradiance(pruned.links);
    const std::vector<vec3> after = lit.irradiance(left);
    for (std::size_t n = 0; n < before.size(); ++n)
        ASSERT_NEAR(after[n].x, before[n].x, 1e-5F * std::abs(before[n].x)) << n;
}

}  // namespace
}  // namespace antiradiance
