// SPDX-License-Identifier: GPL-3.0-or-later
// Final shooting and splatting in OpenGL against the CPU's, over G-buffers of whole rooms with
// random light and antiradiance.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <iostream>
#include <random>

#include "base/error.h"
#include "display/display_backend_gl.h"
#include "display/made_fragments.h"
#include "support/linked_scene.h"
#include "support/scene_builder.h"
#include "support/scenes.h"
#include "support/tree_builder.h"

namespace antiradiance {
namespace {

constexpr int kTile = 8;

constexpr int kWidth = 48, kHeight = 32;
constexpr vec3 kEye(5.8F, 2, 1.5F), kTarget(0, 2, 0.8F);

// Both add the same floats in the same order, each rounded to 6e-8, but compilers contract them
// differently: measured 6e-6 of the mean, where 256 subsets leave one or two sources to a fragment.
// A direction that falls into the next texel of the bins' weights, or a fragment that changes sides
// at a limit of distance, would cost up to a few per cent of one source's share of hundreds.
constexpr double kFloor = 1e-4;

// The largest difference, over the mean.
void expect_close(const std::vector<vec3>& a, const std::vector<vec3>& b) {
    ASSERT_EQ(a.size(), b.size());
    double sum = 0;
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            sum += std::abs(static_cast<double>(b[i][k]));
            largest = std::max(largest, std::abs(static_cast<double>(a[i][k]) - b[i][k]));
        }
    }
    const double mean = sum / (3.0 * static_cast<double>(a.size()));
    ASSERT_GT(mean, 0);
    std::cout << "largest difference " << largest / mean << " of the mean\n";
    EXPECT_LE(largest, kFloor * mean);
}

// A room that a camera sees, with light on its patches that is different everywhere.
struct Lit {
    Scene scene;
    RayScene rays;
    PatchTree tree;
    DirectionBins bins{128};
    BinWeights weights{bins, 64};
    GBuffer buffer;
    std::vector<vec3> radiance;  // #nodes
    AntiradianceTable table;
    Progress progress;

    // given: the tree, if it is not to be a plain one
    Lit(const Scene& room, const vec3& eye, const vec3& target, float max_edge, int width,
        int height, const PatchTree* given = nullptr)
        : scene(room), rays(scene), tree(given ? *given : test::front_tree(scene, max_edge)) {
        scene.has_camera = true;
        Camera& c = scene.camera;
        c.to_world = glm::inverse(glm::lookAt(eye, target, vec3(0, 0, 1)));
        c.width = c.x1 = width;
        c.height = c.y1 = height;
        const DirectLight direct(scene, rays, DirectLightMode::kExplicit, progress);
        radiance.assign(tree.size(), vec3(0));
        buffer = make_gbuffer(
            {scene, scene.camera, rays, tree, &direct, radiance, radiance, true, false, 4, 16},
            progress, {0, 1});
        std::mt19937 random(1);
        std::uniform_real_distribution<float> uniform(0, 1);
        const auto colour = [&] { return vec3(uniform(random), uniform(random), uniform(random)); };
        for (vec3& l : radiance)
            l = colour();
        table.bins = bins.count();
        table.values.resize(tree.size() * static_cast<std::size_t>(table.bins));
        for (vec3& a : table.values)
            a = colour();
    }
    [[nodiscard]] vec3 eye() const { return vec3(scene.camera.to_world[3]); }

    std::vector<vec3> shoot(DisplayBackend& backend, const FragmentGroups& groups,
                            const SourceLists& lists, int interleave = 1, int samples = 8) {
        const PatchLights lights(tree, radiance, samples);
        const ShootingInput input{tree, buffer, groups, lists, radiance, interleave};
        return backend.shoot({input, lights, table, weights, 2 * rays.epsilon()}, progress, {});
    }
    std::vector<vec3> shoot(DisplayBackend& backend, ShootingLevel level, int interleave = 1) {
        const FragmentGroups groups = tile_groups(buffer, eye(), std::max(kTile, interleave));
        const SourceLists lists = level == ShootingLevel::kCut
                                      ? cut_sources(tree, groups, CutRule{}, progress)
                                      : all_sources(tree, level, groups.groups.size());
        return shoot(backend, groups, lists, interleave);
    }
    std::vector<vec3> splat(DisplayBackend& backend) {
        const FragmentGroups groups = tile_groups(buffer, eye(), kTile);
        const SourceLists disks = find_disks(tree, groups, progress);
        return backend.splat({tree, radiance, buffer, groups, disks}, progress, {});
    }
};

Lit lit_office(int width = kWidth, int height = kHeight) {
    return {test::office(), kEye, kTarget, 0.4F, width, height};
}

class GlDisplayTest : public testing::Test {
protected:
    void SetUp() override {
        std::string why_not;
        gl = make_gl_display(why_not);
        if (!gl) GTEST_SKIP() << why_not;
    }
    std::unique_ptr<DisplayBackend> gl;
    std::unique_ptr<DisplayBackend> cpu = make_cpu_display();
};

TEST_F(GlDisplayTest, ShootsLikeTheCpuAtAllLevelsAndInterleaved) {
    Lit room = lit_office();
    for (const ShootingLevel level :
         {ShootingLevel::kLeaves, ShootingLevel::kParents, ShootingLevel::kCut}) {
        for (const int interleave : {1, 3, 16}) {
            SCOPED_TRACE(testing::Message()
                         << "level " << static_cast<int>(level) << ", interleave " << interleave);
            expect_close(room.shoot(*gl, level, interleave), room.shoot(*cpu, level, interleave));
        }
    }
}

TEST_F(GlDisplayTest, ShootsLikeTheCpuWithAnyNumberOfPoints) {
    Lit room = lit_office();
    const FragmentGroups groups = tile_groups(room.buffer, room.eye(), kTile);
    const SourceLists lists = cut_sources(room.tree, groups, CutRule{}, room.progress);
    for (const int samples : {1, 3, 16}) {
        SCOPED_TRACE(testing::Message() << samples << " points");
        expect_close(room.shoot(*gl, groups, lists, 1, samples),
                     room.shoot(*cpu, groups, lists, 1, samples));
    }
}

TEST_F(GlDisplayTest, ShootsLikeTheCpuWithClustersAndTriangles) {
    Scene scene = test::floating_boxes(4);
    test::add_polygon(scene, "Triangle", {{0.2F, 0.2F, 3}, {3.8F, 0.2F, 3}, {2, 3.8F, 3.2F}}, 0);
    Lit room(scene, vec3(3.9F, 3.9F, 3.7F), vec3(0.5F), 1, 24, 16);
    const FragmentGroups groups = tile_groups(room.buffer, room.eye(), kTile);
    const SourceLists lists = cut_sources(room.tree, groups, CutRule{}, room.progress);
    ASSERT_TRUE(std::any_of(lists.sources.begin(), lists.sources.end(),
                            [&](NodeId n) { return room.tree.is_cluster(n); }));
    expect_close(room.shoot(*gl, groups, lists), room.shoot(*cpu, groups, lists));
}

TEST_F(GlDisplayTest, ShootsLikeTheCpuOverLinkedLists) {
    RefineOptions refine;
    refine.link_threshold = 0.2F;
    refine.least_edge = 0.4F;
    refine.antiradiance = false;
    const test::LinkedScene linked(test::office(), 0.8F, refine);
    Lit room(test::office(), kEye, kTarget, 0.8F, kWidth, kHeight, &linked.tree);
    const LinkSet links = linked.sorted();
    const FragmentGroups groups = receiver_groups(room.buffer);
    for (const ShootingLevel level : {ShootingLevel::kLeaves, ShootingLevel::kCut}) {
        SCOPED_TRACE(testing::Message() << "level " << static_cast<int>(level));
        const SourceLists lists =
            linked_sources(room.tree, links, room.buffer, groups, level, CutRule{}, room.progress);
        ASSERT_GT(lists.sources.size(), groups.groups.size());
        expect_close(room.shoot(*gl, groups, lists), room.shoot(*cpu, groups, lists));
    }
}

// What test_shooting.cpp asks of the CPU: an exact answer, not only the CPU's.
TEST_F(GlDisplayTest, ARoomOfRadiance1BringsPiEverywhere) {
    Scene scene;
    test::add_box(scene, "room", vec3(0), vec3(1), test::add_material(scene, vec3(0.5F)),
                  test::Facing::kInward);
    Lit room(scene, vec3(0.9F, 0.8F, 0.7F), vec3(0.1F, 0.2F, 0.3F), 0.13F, 24, 16);
    room.radiance.assign(room.tree.size(), vec3(1));
    for (const vec3& e : room.shoot(*gl, ShootingLevel::kCut))
        EXPECT_NEAR(e.x, kPi, 0.01F * kPi);
}

TEST_F(GlDisplayTest, SplatsLikeTheCpu) {
    Lit room = lit_office();
    expect_close(room.splat(*gl), room.splat(*cpu));
}

// Sums have one order, however they are cut into buffers and dispatches.
TEST_F(GlDisplayTest, EveryWayToCutTheWorkGivesTheSame) {
    Lit room = lit_office(16, 12);
    const std::vector<vec3> shot = room.shoot(*gl, ShootingLevel::kLeaves, 3);
    const std::vector<vec3> splatted = room.splat(*gl);
    EXPECT_EQ(room.shoot(*gl, ShootingLevel::kLeaves, 3), shot) << "a second time";
    const std::size_t row = 128 * sizeof(vec3);  // of antiradiance
    const GlDisplayConfig cuts[] = {
        {.block_bytes = 700 * row},                            // three ranges of nodes
        {.block_bytes = 40000},                                // batches of fragments as well
        {.places_per_dispatch = 100},                          // no multiple of a work group
        {.block_bytes = 100000, .places_per_dispatch = 1000},  // all of it
    };
    ASSERT_GT(room.tree.size(), 1400U);
    for (const GlDisplayConfig& cut : cuts) {
        SCOPED_TRACE(testing::Message() << "case " << &cut - &cuts[0]);
        std::string why_not;
        const std::unique_ptr<DisplayBackend> part = make_gl_display(cut, why_not);
        EXPECT_EQ(room.shoot(*part, ShootingLevel::kLeaves, 3), shot);
        EXPECT_EQ(room.splat(*part), splatted);
    }
}

TEST_F(GlDisplayTest, FragmentsWithoutSourcesStayDark) {
    Lit room = lit_office();
    const FragmentGroups groups = tile_groups(room.buffer, room.eye(), kTile);
    SourceLists none;
    none.begin.assign(groups.groups.size(), 0);
    none.end.assign(groups.groups.size(), 0);
    for (const vec3& e : room.shoot(*gl, groups, none))
        EXPECT_EQ(e, vec3(0));
    room.buffer = test::empty_buffer(kWidth, kHeight);
    EXPECT_TRUE(room.shoot(*gl, ShootingLevel::kCut).empty());
}

TEST_F(GlDisplayTest, CancelsWithinHalfASecond) {
    using Clock = std::chrono::steady_clock;
    Lit room = lit_office(256, 192);  // seconds on a software renderer
    const FragmentGroups groups = tile_groups(room.buffer, room.eye(), kTile);
    const SourceLists lists = all_sources(room.tree, ShootingLevel::kLeaves, groups.groups.size());
    const PatchLights lights(room.tree, room.radiance, 8);
    const ShootingInput input{room.tree, room.buffer, groups, lists, room.radiance, 1};
    for (const int reports : {1, 10}) {
        Clock::time_point asked{};
        float last = 0.5F;
        int seen = 0;
        Progress progress(
            [&](float fraction, const std::string&) {
                EXPECT_GE(fraction, last);
                EXPECT_LE(fraction, 1);
                last = fraction;
                if (++seen == reports) asked = Clock::now();
            },
            [&] { return seen >= reports; });
        EXPECT_THROW(
            (void)gl->shoot({input, lights, room.table, room.weights, 1e-4F}, progress, {0.5F, 1}),
            Cancelled);
        EXPECT_LT(std::chrono::duration<double>(Clock::now() - asked).count(), 0.5);
    }
}

TEST(NoGlDisplay, GivesTheReason) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    const auto make = [] {
        setenv("ANTIRADIANCE_NO_OPENGL", "1", 1);
        std::string why_not;
        const bool null = make_gl_display(why_not) == nullptr;
        std::cerr << why_not;
        std::exit(null ? 0 : 1);
    };
    EXPECT_EXIT(make(), testing::ExitedWithCode(0), "ANTIRADIANCE_NO_OPENGL");
}

}  // namespace
}  // namespace antiradiance
