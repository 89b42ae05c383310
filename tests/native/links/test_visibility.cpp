// SPDX-License-Identifier: GPL-3.0-or-later
#include "links/link_pairs.h"
#include "links/visibility.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "support/linked_scene.h"
#include "support/scene_builder.h"

namespace antiradiance {
namespace {

using test::LinkedScene;

const vec3 kX(1, 0, 0);
const vec3 kY(0, 1, 0);

// A floor and a ceiling of 1 m2 at height 1, and a screen half way up over x < `screen`, whose
// faces take no part (their links are not looked at).
Scene screened(float screen) {
    Scene scene;
    const int m = test::add_material(scene, vec3(0.5F));
    test::add_quad(scene, "Floor", vec3(0), kX, kY, m);
    test::add_quad(scene, "Ceiling", vec3(0, 0, 1), kY, kX, m);
    if (screen > 0)
        test::add_quad(scene, "Screen", vec3(-1, -1, 0.5F), (1 + screen) * kX, 3.0F * kY, m);
    return scene;
}

// Sum over links from the ceiling to the floor of receiver area times form factor, m2.
double floor_light(const Scene& scene, int rays_per_pair, float max_edge) {
    RefineOptions options;
    options.antiradiance = false;
    options.least_edge = max_edge;
    options.receiver_levels = 0;
    LinkedScene linked(scene, max_edge, options);
    const RayScene rays(scene);
    Progress progress;
    if (rays_per_pair > 0) {
        apply_ray_visibility(linked.tree, rays, {rays_per_pair}, linked.refined.pairs,
                             linked.refined.links, progress);
    }
    const PatchTree& tree = linked.tree;
    const auto object = [&](NodeId n) {
        return tree.surfaces[static_cast<std::size_t>(tree.surface[static_cast<std::size_t>(n)])]
            .object;
    };
    double sum = 0;
    for (const RawLink& l : linked.refined.links) {
        if (object(l.source) == 1 && object(l.receiver) == 0)
            sum += tree.area[static_cast<std::size_t>(l.receiver)] * l.form_factor;
    }
    return sum;
}

TEST(RayVisibility, NothingIsLostInTheOpen) {
    EXPECT_NEAR(floor_light(screened(0), 4, 0.3F), .199824896, .199824896 * 0.002);
    EXPECT_EQ(floor_light(screened(0), 4, 0.3F), floor_light(screened(0), 0, 0.3F));
}

TEST(RayVisibility, ABlockedWallReceivesNothing) {
    EXPECT_EQ(floor_light(screened(2), 1, 0.3F), 0);
    EXPECT_EQ(floor_light(screened(2), 16, 0.3F), 0);
}

TEST(RayVisibility, AHalfScreenHidesHalf) {
    // A segment between the squares crosses the plane of the screen in its middle; by symmetry
    // about x = 1/2 just as many lie left as right of its edge there.
    const double open = floor_light(screened(0), 0, 0.3F);
    for (const int rays : {1, 4, 16}) {
        // Some 500 pairs whose share of 1/2 is known to 1 / (2 sqrt rays) each: three deviations.
        EXPECT_NEAR(floor_light(screened(0.5F), rays, 0.15F) / open, 0.5,
                    3 * 0.5 / std::sqrt(500.0 * rays))
            << rays;
    }
}

TEST(RayVisibility, AgreesWithManyRaysBetweenPoints) {
    // Screen over a third: reference by 2 x 10^5 random segments, weighted by their transfer.
    const Scene scene = screened(0.3F);
    const RayScene rays(scene);
    double free = 0, all = 0;
    for (std::uint32_t i = 0; i < 200'000; ++i) {
        const auto random = [&](std::uint32_t k) { return to_unit_float(hash_combine(k, i)); };
        const vec3 a(random(1), random(2), 0);
        const vec3 b(random(3), random(4), 1);
        const vec3 d = b - a;
        const double transfer = 1 / std::pow(static_cast<double>(glm::dot(d, d)), 2);
        all += transfer;
        if (!rays.occluded(a + vec3(0, 0, 1e-4F), b - vec3(0, 0, 1e-4F))) free += transfer;
    }
    const double share = floor_light(scene, 8, 0.15F) / floor_light(scene, 0, 0.15F);
    EXPECT_NEAR(share, free / all, 0.01);
}

TEST(RayVisibility, FourRaysAreNearToManyRays) {
    const Scene scene = screened(0.3F);
    const RayScene rays(scene);
    RefineOptions options;
    options.antiradiance = false;
    options.least_edge = 0.15F;
    const LinkedScene open(scene, 0.15F, options);
    const auto links_by = [&](int count) {
        std::vector<RawLink> links = open.refined.links;
        Progress progress;
        apply_ray_visibility(open.tree, rays, {count}, open.refined.pairs, links, progress);
        return links;
    };
    const std::vector<RawLink> few = links_by(4);
    const std::vector<RawLink> many = links_by(1024);
    double squares = 0;
    int partly = 0;
    for (std::size_t i = 0; i < few.size(); ++i) {
        const float whole = open.refined.links[i].form_factor;
        const float v = many[i].form_factor / whole;
        if (v < 0.02F || v > 0.98F) continue;
        const float off = few[i].form_factor / whole - v;
        squares += static_cast<double>(off) * off;
        ++partly;
    }
    ASSERT_GT(partly, 100);
    const double rms = std::sqrt(squares / partly);
    // Four independent rays of these links would be .2 off.
    EXPECT_LT(rms, 0.18);
}

TEST(RayVisibility, DoesNotDependOnTheOrderOfPairs) {
    const Scene scene = screened(0.5F);
    const RayScene rays(scene);
    RefineOptions options;
    options.antiradiance = false;
    options.least_edge = 0.2F;
    LinkedScene forwards(scene, 0.3F, options);
    LinkedScene backwards = forwards;
    std::reverse(backwards.refined.pairs.begin(), backwards.refined.pairs.end());
    Progress progress;
    for (LinkedScene* l : {&forwards, &backwards})
        apply_ray_visibility(l->tree, rays, {4}, l->refined.pairs, l->refined.links, progress);
    for (std::size_t i = 0; i < forwards.refined.links.size(); ++i)
        ASSERT_EQ(forwards.refined.links[i].form_factor, backwards.refined.links[i].form_factor);
}

TEST(RayVisibility, IsThatOfThePairWhicheverComesFirst) {
    const Scene scene = screened(0.5F);
    const RayScene rays(scene);
    const LinkedScene linked(scene, 0.3F, {.least_edge = 0.2F, .antiradiance = false});
    std::vector<TestedPair> pairs;
    for (const LinkedPair& p : linked.refined.pairs)
        pairs.push_back({p.a, p.b, 1, 3});
    std::vector<TestedPair> turned = pairs;
    for (TestedPair& p : turned)
        std::swap(p.a, p.b);
    Progress progress;
    const std::vector<float> seen = trace_pairs(linked.tree, rays, pairs, progress);
    EXPECT_EQ(seen, trace_pairs(linked.tree, rays, turned, progress));
    EXPECT_GT(std::ranges::count(seen, 0.0F), 0);
    EXPECT_GT(std::ranges::count(seen, 1.0F), 0);
}

// Refinement knows the pairs beforehand, whoever has the sorted links finds them again.
TEST(LinkPairs, WeighLinksAsRefinementsPairsDo) {
    const Scene scene = screened(0.5F);
    const RayScene rays(scene);
    // Touching patches among them, whose links are spread over several bins.
    LinkedScene linked(scene, 0.5F, {.link_threshold = 0.1F, .least_edge = 0.2F});
    const VisibilityRays graded{.per_pair = 4, .graded = true};
    Progress progress;
    const LinkSet before = build_link_set(linked.tree, linked.bins, linked.refined.links, progress);
    const std::size_t traced = apply_ray_visibility(linked.tree, rays, graded, linked.refined.pairs,
                                                    linked.refined.links, progress);
    std::erase_if(linked.refined.links, [](const RawLink& l) { return l.form_factor < 0; });
    const LinkSet wanted = build_link_set(linked.tree, linked.bins, linked.refined.links, progress);

    LinkPairs pairs = pair_links(linked.tree, before);
    EXPECT_EQ(count_rays(linked.tree, graded, pairs.pairs), traced);
    const std::vector<float> visible = trace_pairs(linked.tree, rays, pairs.pairs, progress);
    std::size_t at = 0;
    for (std::size_t l = 0; l < before.links.size(); ++l) {
        if (pairs.of_link[l] == kNoPair) {
            ASSERT_LT(before.links[l].form_factor, 0);
            continue;
        }
        const float ff = before.links[l].form_factor * visible[pairs.of_link[l]];
        if (ff == 0) continue;
        ASSERT_LT(at, wanted.links.size());
        ASSERT_EQ(wanted.links[at].source, before.links[l].source);
        ASSERT_EQ(wanted.links[at].form_factor, ff);
        ++at;
    }
    EXPECT_EQ(at, wanted.links.size());
    EXPECT_GT(before.radiance_count, pairs.pairs.size());
    EXPECT_GT(before.antiradiance_count, 0U);
    EXPECT_LT(wanted.radiance_count, before.radiance_count);
}

TEST(CountRays, GradesPairsByTheirShareOfTheMean) {
    // The floor and the ceiling; neither shines.
    const LinkedScene linked(screened(0), 2, {.least_edge = 2, .antiradiance = false});
    // Mean 1 over those that carry anything.
    const std::vector<TestedPair> made{{0, 1, 0.1}, {0, 1, 0.6}, {0, 1, 0.1},
                                       {0, 1, 4.5}, {0, 1, 0},   {0, 1, 0.1},
                                       {0, 1, 0.6}, {0, 1, 1},   {0, 1, 1}};
    const auto counts = [&](const VisibilityRays& rays) {
        std::vector<TestedPair> pairs = made;
        std::size_t total = count_rays(linked.tree, rays, pairs);
        std::vector<int> result;
        for (const TestedPair& p : pairs) {
            result.push_back(p.rays);
            total -= static_cast<std::size_t>(p.rays);
        }
        EXPECT_EQ(total, 0U);
        return result;
    };
    EXPECT_EQ(counts({.per_pair = 4, .graded = true}),
              (std::vector<int>{1, 4, 1, 9, 0, 1, 4, 4, 4}));
    EXPECT_EQ(counts({.per_pair = 16, .graded = true}),
              (std::vector<int>{4, 16, 4, 36, 0, 4, 16, 16, 16}));
    EXPECT_EQ(counts({.per_pair = 1, .graded = true}),
              (std::vector<int>{1, 1, 1, 2, 0, 1, 1, 1, 1}));
    EXPECT_EQ(counts({.per_pair = 4}), (std::vector<int>{4, 4, 4, 4, 0, 4, 4, 4, 4}));
}

TEST(CountRays, EmittersGetMost) {
    Scene scene;
    const int dull = test::add_material(scene, vec3(0.5F));
    const int bright = test::add_material(scene, vec3(0.5F), vec3(1));
    test::add_quad(scene, "Floor", vec3(0), kX, kY, dull);
    test::add_quad(scene, "Lamp", vec3(0, 0, 1), kY, kX, bright);
    const LinkedScene linked(scene, 2, {.least_edge = 2, .antiradiance = false});
    ASSERT_EQ(linked.refined.pairs.size(), 1U);
    const auto rays_for = [&](bool shine) {
        std::vector<TestedPair> pairs{{linked.refined.pairs[0].a, linked.refined.pairs[0].b, 0.2}};
        return count_rays(linked.tree, {4, true, shine}, pairs);
    };
    EXPECT_EQ(rays_for(true), 16U);
    EXPECT_EQ(rays_for(false), 4U);
}

TEST(SurfaceSampler, CoversAClusterByArea) {
    const LinkedScene linked(screened(0.5F), 0.3F, {.least_edge = 0.3F});
    const SurfaceSampler sampler(linked.tree);
    int floor = 0;
    constexpr int kSamples = 10'000;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const auto s = sampler.sample(0, r2_sample(i, 3));
        if (s.point.z < 0.01F) ++floor;
        ASSERT_NEAR(glm::length(s.normal), 1, 1e-5F);
    }
    // 1 of 1 + 1 + 4.5 m2
    EXPECT_NEAR(static_cast<double>(floor) / kSamples, 1 / 6.5, 0.01);
}

TEST(SurfaceSampler, StaysOnTheExposedPart) {
    LinkedScene linked(screened(0), 9, {.least_edge = 9});
    PatchTree& tree = linked.tree;
    ASSERT_EQ(tree.leaves.size(), 2U);
    const auto floor = static_cast<std::size_t>(
        tree.center[static_cast<std::size_t>(tree.leaves[0])].z < 0.5F ? tree.leaves[0]
                                                                       : tree.leaves[1]);
    tree.exposed[floor] = 0.25F;
    tree.exposed_mask[floor] = 0x000F;  // the strata with j = 0
    const SurfaceSampler sampler(tree);
    const auto corners = tree.patch_corners(static_cast<NodeId>(floor));
    const vec3 v = corners[3] - corners[0];  // j runs along it
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const auto s = sampler.sample(static_cast<NodeId>(floor), r2_sample(i, 3));
        const float along = glm::dot(s.point - corners[0], v) / glm::dot(v, v);
        ASSERT_GE(along, -1e-6F);
        ASSERT_LE(along, 0.25F + 1e-6F);
    }
}

}  // namespace
}  // namespace antiradiance
