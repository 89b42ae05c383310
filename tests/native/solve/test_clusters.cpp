// SPDX-License-Identifier: GPL-3.0-or-later
// EXPLICIT with links between clusters against links between polygons, on one scene.
#include <gtest/gtest.h>

#include <cmath>

#include "hierarchy/patch_materials.h"
#include "links/visibility.h"
#include "solve/row_normalisation.h"
#include "support/linked_scene.h"
#include "support/scenes.h"
#include "support/solvers.h"

namespace antiradiance {
namespace {

using Clusters = test::OnEachSolver;
INSTANTIATE_TEST_SUITE_P(, Clusters, test::each_solver(), test::solver_name);

struct Linked {
    PatchTree tree;
    LinkSet links;
    std::vector<float> row_scale;
    PatchMaterials materials;
    std::size_t cluster_links = 0;

    Linked(const Scene& scene, const RayScene& rays, bool clusters) {
        RefineOptions options;
        options.antiradiance = false;
        options.cluster_links = clusters;
        options.link_threshold = 0.05F;
        options.least_edge = 0.15F;  // the boxes have edges of .2 and more: still split
        test::LinkedScene linked(scene, 0.6F, options);
        Progress progress;
        apply_ray_visibility(linked.tree, rays, {4}, linked.refined.pairs, linked.refined.links,
                             progress);
        links = linked.sorted();
        tree = std::move(linked.tree);
        row_scale = row_scales(tree, links, {}, rays, {}, progress);
        materials = average_materials(scene, tree);
        for (const Segment& s : links.segments) {
            for (std::uint32_t l = s.begin; l < s.end; ++l) {
                if (tree.is_cluster(s.receiver) || tree.is_cluster(links.links[l].source))
                    ++cluster_links;
            }
        }
    }
    [[nodiscard]] TransportProblem problem() const {
        return {tree, links, materials.emission, materials.albedo, row_scale};
    }
};

TEST_P(Clusters, GiveTheLightOfPolygonsWithFewerLinks) {
    const Scene scene = test::floating_boxes(5);
    const RayScene rays(scene);
    const Linked polygons(scene, rays, false);
    const Linked clusters(scene, rays, true);
    EXPECT_EQ(polygons.cluster_links, 0U);
    EXPECT_GT(clusters.cluster_links, 1000U);
    EXPECT_LT(clusters.links.links.size(), polygons.links.links.size());
    const Solution a = solver->solve(polygons.problem(), {}, progress);
    const Solution b = solver->solve(clusters.problem(), {}, progress);
    EXPECT_TRUE(a.converged);
    EXPECT_TRUE(b.converged);

    double squares = 0, expected = 0, mean = 0, area = 0;
    for (const NodeId leaf : polygons.tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        const Surface& s =
            polygons.tree.surfaces[static_cast<std::size_t>(polygons.tree.surface[n])];
        const NodeId same =
            clusters.tree.lookup(s.triangles[0], s.back_side, polygons.tree.center[n]);
        const double w = polygons.tree.area[n];
        const double x = a.irradiance[n].x;
        const double y = b.irradiance[static_cast<std::size_t>(same)].x;
        squares += w * (x - y) * (x - y);
        expected += w * x;
        mean += w * y;
        area += w;
    }
    const double rms = std::sqrt(squares / area) / (expected / area);
    std::cout << polygons.links.links.size() << " links between polygons, "
              << clusters.links.links.size() << " with clusters; relative RMS " << rms << ", bias "
              << mean / expected - 1 << "\n";
    // Both are 4-ray estimates on coarse patches, .095 apart; the mean is what moments keep.
    EXPECT_LT(rms, 0.12);
    EXPECT_NEAR(mean / expected, 1, 0.02);
}

}  // namespace
}  // namespace antiradiance
