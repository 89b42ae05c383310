// SPDX-License-Identifier: GPL-3.0-or-later
// The rules on link meshes of whole scenes.
#include "prune/prune.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <set>
#include <string>

#include "base/error.h"
#include "base/random.h"
#include "prune/evaluate.h"
#include "prune/ray_visibility.h"
#include "support/linked_scene.h"
#include "support/scene_builder.h"
#include "support/scenes.h"

namespace antiradiance {
namespace {

struct Linked {
    Scene scene;
    test::LinkedScene linked;
    LinkSet links;
    RayScene rays;

    explicit Linked(Scene made, float max_edge = 0.8F, bool clusters = false)
        : scene(std::move(made)),
          linked(
              scene, max_edge,
              {.link_threshold = 0.05F, .least_edge = 0.5F * max_edge, .cluster_links = clusters}),
          links(linked.sorted()),
          rays(scene) {}
    [[nodiscard]] PruneInput input() const { return {scene, linked.tree, links, rays}; }
    [[nodiscard]] RemovedLinks removed(const PruneOptions& options) const {
        Progress progress;
        return find_removed_links(input(), options, progress);
    }
};

// Boxes and sheets at random in a room, turned at random.
Scene random_room(std::uint32_t seed) {
    std::uint32_t state = hash_u32(seed + 1);
    const auto random = [&](float low, float high) {
        state = hash_u32(state + 1);
        return low + (high - low) * to_unit_float(state);
    };
    Scene scene;
    test::add_material(scene, vec3(0.5F));
    test::add_box(scene, "Room", vec3(0), vec3(3), 0, test::Facing::kInward);
    for (int i = 0; i < 3; ++i) {
        const vec3 low(random(0.2F, 1.8F), random(0.2F, 1.8F), random(0.2F, 1.8F));
        test::add_box(scene, "Box", low,
                      low + vec3(random(0.1F, 1), random(0.1F, 1), random(0.1F, 1)), 0);
    }
    for (int i = 0; i < 3; ++i) {
        const vec3 axis(random(-1, 1), random(-1, 1), random(-1, 1));
        const mat4 turn = glm::translate(mat4(1), vec3(random(1, 2), random(1, 2), random(1, 2))) *
                          glm::rotate(mat4(1), random(0, 2 * kPi), glm::normalize(axis));
        const float size = random(0.3F, 0.9F);
        test::add_polygon(scene, "Sheet",
                          {{-size, -size, 0}, {size, -size, 0}, {size, size, 0}, {-size, size, 0}},
                          0, {}, turn);
    }
    return scene;
}

struct Wrong {
    std::size_t removed = 0;
    std::size_t seen = 0;  // by rays
};
Wrong removed_plus_links(const Linked& l) {
    // Every blocked + link goes.
    const RemovedLinks removed = l.removed({.method = PruneMethod::kConservative,
                                            .conservative_keeps = ConservativeKeeps::kAlgorithm3});
    RemovedLinks others(removed.size());
    for (std::size_t i = 0; i < others.size(); ++i)
        others[i] = !removed[i] || l.links.links[i].form_factor < 0 ? 1 : 0;
    Progress progress;
    const LinkSet left = remove_links(l.links, others);
    const RemovedLinks invisible =
        invisible_links(trace_visibility(l.scene, l.linked.tree, left, l.rays, {}, progress));
    return {invisible.size(),
            static_cast<std::size_t>(std::count(invisible.begin(), invisible.end(), 0))};
}

TEST(Conservative, RemovesNoLightThatRaysSee) {
    std::size_t removed = 0;
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        const Wrong wrong = removed_plus_links(Linked(random_room(seed)));
        EXPECT_EQ(wrong.seen, 0U) << "scene " << seed;
        removed += wrong.removed;
    }
    EXPECT_GT(removed, 1000U);
    for (const Scene& scene : {test::office(), test::corridor(), test::floating_boxes(2)}) {
        const Wrong wrong = removed_plus_links(Linked(scene));
        EXPECT_EQ(wrong.seen, 0U) << scene.objects.back().name;
        EXPECT_GT(wrong.removed, 500U) << scene.objects.back().name;
    }
}

// Of the marked links those with a cluster at an end.
std::size_t count_at_clusters(const Linked& l, const RemovedLinks& marked) {
    std::size_t count = 0;
    for (const Segment& s : l.links.segments) {
        for (LinkId i = s.begin; i < s.end; ++i) {
            if (marked[i] && (l.linked.tree.is_cluster(s.receiver) ||
                              l.linked.tree.is_cluster(l.links.links[i].source)))
                ++count;
        }
    }
    return count;
}

// Antiradiance has no clusters, so no render makes the second of these; but the rules take it.
Linked boxes_without_clusters() {
    return Linked(test::floating_boxes(3), 0.8F, false);
}
Linked boxes_with_clusters() {
    return Linked(test::floating_boxes(3), 0.8F, true);
}

TEST(PruneRules, AreGivenNoClustersByDefault) {
    EXPECT_FALSE(RefineOptions().cluster_links);
    const Linked l = boxes_without_clusters();
    EXPECT_EQ(count_at_clusters(l, RemovedLinks(l.links.links.size(), 1)), 0U);
}

TEST(Conservative, RemovesNoLightOfClustersThatRaysSee) {
    const Linked l = boxes_with_clusters();
    const Wrong wrong = removed_plus_links(l);
    EXPECT_EQ(wrong.seen, 0U);
    const RemovedLinks removed = l.removed({.method = PruneMethod::kConservative,
                                            .conservative_keeps = ConservativeKeeps::kAlgorithm3});
    EXPECT_GT(count_at_clusters(l, removed), 100U);
}

TEST(PruneRules, TakeLinksOfClusters) {
    const Linked l = boxes_with_clusters();
    for (const PruneRule& rule : prune_rules())
        EXPECT_GT(count_at_clusters(l, l.removed({.method = rule.method})), 0U) << rule.identifier;
}

TEST(PruneRules, CompareInOrderWithTheStudy) {
    // algorithm.md "Pruning": heuristic 1 finds little, conservative less than heuristic 2, which
    // finds less than rays do; of what is removed, rays see least after the conservative rule.
    const Linked l(test::corridor());
    Progress progress;
    const RemovedLinks invisible =
        invisible_links(trace_visibility(l.scene, l.linked.tree, l.links, l.rays, {}, progress));
    const auto evaluated = [&](PruneMethod method) {
        return evaluate_pruning(l.linked.tree, l.links, l.removed({.method = method}), invisible,
                                0);
    };
    const PruneEvaluation first = evaluated(PruneMethod::kHeuristic1);
    const PruneEvaluation second = evaluated(PruneMethod::kHeuristic2);
    const PruneEvaluation safe = evaluated(PruneMethod::kConservative);
    const PruneEvaluation oracle = evaluated(PruneMethod::kOracle2);
    EXPECT_LT(first.removed, safe.removed / 4);
    EXPECT_LT(safe.removed, second.removed);
    EXPECT_LT(second.removed, second.explicit_test);
    EXPECT_LT(oracle.removed, oracle.explicit_test) << "algorithm 3 keeps some";
    EXPECT_EQ(oracle.incorrect, 0U);
    const auto share = [](const PruneEvaluation& e) {
        return static_cast<double>(e.incorrect) / static_cast<double>(e.removed);
    };
    EXPECT_EQ(safe.incorrect_radiance, 0U);
    EXPECT_LE(share(safe), 0.0001);
    EXPECT_LT(share(safe), share(second));
    EXPECT_LT(share(second), 0.2);
    EXPECT_LT(share(second), share(first));
}

TEST(PruneRules, EachHasARowInTheOrderOfTheMethods) {
    std::set<std::string> identifiers;
    for (std::size_t i = 0; i < prune_rules().size(); ++i) {
        EXPECT_EQ(static_cast<std::size_t>(prune_rules()[i].method), i + 1);  // after kNone
        identifiers.insert(prune_rules()[i].identifier);
    }
    EXPECT_EQ(identifiers,
              (std::set<std::string>{"HEURISTIC_1", "HEURISTIC_2", "HEURISTIC_2_THEN_1",
                                     "CONSERVATIVE", "ORACLE_1", "ORACLE_2"}));
}

TEST(PruneRules, DoNotDependOnThreads) {
    const Linked l(test::office());
    for (const PruneRule& rule : prune_rules()) {
        const PruneOptions options{.method = rule.method, .rays_per_link = 4};
        const RemovedLinks many = l.removed(options);
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        EXPECT_EQ(l.removed(options), many) << rule.identifier;
        EXPECT_GT(std::count(many.begin(), many.end(), 1), 0) << rule.identifier;
    }
}

TEST(PruneRules, StopWhenAsked) {
    const Linked l(test::office());
    for (const PruneRule& rule : prune_rules()) {
        Progress progress;
        progress.cancel();
        EXPECT_THROW(prune_links(l.input(), {.method = rule.method}, progress), Cancelled)
            << rule.identifier;
    }
}

TEST(PruneRules, TakeALinkSetWithoutLinks) {
    const Linked l(test::office());
    const LinkSet none;
    Progress progress;
    for (const PruneRule& rule : prune_rules()) {
        const PruneResult result =
            prune_links({l.scene, l.linked.tree, none, l.rays}, {.method = rule.method}, progress);
        EXPECT_TRUE(result.links.links.empty());
    }
}

TEST(PruneLinks, CountsWhatItRemoves) {
    const Linked l(test::office());
    const PruneOptions options{.method = PruneMethod::kHeuristic2};
    const RemovedLinks removed = l.removed(options);
    Progress progress;
    const PruneResult result = prune_links(l.input(), options, progress);
    std::size_t plus = 0, minus = 0;
    for (std::size_t i = 0; i < removed.size(); ++i) {
        if (removed[i]) ++(l.links.links[i].form_factor > 0 ? plus : minus);
    }
    EXPECT_EQ(result.removed_radiance, plus);
    EXPECT_EQ(result.removed_antiradiance, minus);
    EXPECT_EQ(result.links.links.size() + plus + minus, l.links.links.size());
    EXPECT_GT(result.seconds, 0);
}

TEST(RemoveLinks, IsWhatBuildingWithoutThemGives) {
    const Linked l(test::office());
    RemovedLinks removed(l.links.links.size(), 0);
    for (std::size_t i = 0; i < removed.size(); ++i)
        removed[i] = hash_u32(static_cast<std::uint32_t>(i)) % 3 != 0;
    // Whole bins as well, in the middle and at the end.
    for (const std::size_t b : {std::size_t{40}, std::size_t{41}, std::size_t{127}}) {
        for (std::uint32_t s = l.links.bin_segments[b]; s < l.links.bin_segments[b + 1]; ++s)
            std::fill(removed.begin() + l.links.segments[s].begin,
                      removed.begin() + l.links.segments[s].end, 1);
    }
    std::vector<RawLink> raw;
    for (std::size_t b = 0; b + 1 < l.links.bin_segments.size(); ++b) {
        for (std::uint32_t i = l.links.bin_segments[b]; i < l.links.bin_segments[b + 1]; ++i) {
            const Segment& s = l.links.segments[i];
            for (std::uint32_t k = s.begin; k < s.end; ++k) {
                if (!removed[k])
                    raw.push_back({s.receiver, l.links.links[k].source,
                                   l.links.links[k].form_factor, static_cast<std::uint16_t>(b)});
            }
        }
    }
    Progress progress;
    const LinkSet expected = build_link_set(l.linked.tree, l.links.bins, raw, progress);
    const LinkSet kept = remove_links(l.links, removed);
    EXPECT_EQ(kept.radiance_count, expected.radiance_count);
    EXPECT_EQ(kept.antiradiance_count, expected.antiradiance_count);
    EXPECT_EQ(kept.bin_segments, expected.bin_segments);
    ASSERT_EQ(kept.segments.size(), expected.segments.size());
    for (std::size_t i = 0; i < kept.segments.size(); ++i) {
        ASSERT_EQ(kept.segments[i].receiver, expected.segments[i].receiver);
        ASSERT_EQ(kept.segments[i].begin, expected.segments[i].begin);
        ASSERT_EQ(kept.segments[i].end, expected.segments[i].end);
        ASSERT_EQ(kept.segments[i].inv_c, expected.segments[i].inv_c);
    }
    ASSERT_EQ(kept.links.size(), expected.links.size());
    for (std::size_t i = 0; i < kept.links.size(); ++i) {
        ASSERT_EQ(kept.links[i].source, expected.links[i].source);
        ASSERT_EQ(kept.links[i].form_factor, expected.links[i].form_factor);
    }
}

TEST(EvaluatePruning, CountsARow) {
    LinkSet links;
    links.links = {{0, 1}, {0, 1}, {0, -1}, {0, -1}, {0, 1}};
    const RemovedLinks removed{1, 0, 1, 1, 1};
    const RemovedLinks reference{1, 1, 0, 1, 0};
    const PruneEvaluation e = evaluate_pruning({}, links, removed, reference, 2);
    EXPECT_EQ(e.links, 5U);
    EXPECT_EQ(e.explicit_test, 3U);
    EXPECT_EQ(e.removed, 4U);
    EXPECT_EQ(e.incorrect, 2U);
    EXPECT_EQ(e.incorrect_radiance, 1U);
    EXPECT_EQ(e.not_removed, 1U);
    EXPECT_EQ(e.seconds, 2);
}

}  // namespace
}  // namespace antiradiance
