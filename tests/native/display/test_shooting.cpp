// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numeric>

#include "base/random.h"
#include "display/interleave.h"
#include "display/made_fragments.h"
#include "display/shooting.h"
#include "display/splatting.h"
#include "links/form_factor.h"
#include "support/scene_builder.h"
#include "support/tree_builder.h"

namespace antiradiance {
namespace {

constexpr vec3 kUp(0, 0, 1);

// Final shooting over hand-made fragments; radiance and antiradiance are the same everywhere.
class Shooting : public testing::Test {
protected:
    void set_tree(PatchTree tree) {
        tree_ = std::move(tree);
        radiance_.assign(tree_.size(), vec3(0));
        table_.bins = bins_.count();
        table_.values.assign(tree_.size() * static_cast<std::size_t>(bins_.count()), vec3(0));
    }

    // The room [0,1]^3, seen from inside.
    void set_unit_room() {
        const int white = test::add_material(scene_, vec3(0.5F));
        test::add_box(scene_, "room", vec3(0), vec3(1), white, test::Facing::kInward);
        set_tree(test::front_tree(scene_, 0.13F));
        radiance_.assign(tree_.size(), vec3(1));
    }

    [[nodiscard]] std::vector<vec3> shoot_at(const GBuffer& buffer, ShootingLevel level,
                                             int interleave = 1) const {
        Progress progress;
        const FragmentGroups groups = tile_groups(buffer, vec3(0.5F), 8);
        const SourceLists sources = level == ShootingLevel::kCut
                                        ? cut_sources(tree_, groups, CutRule{}, progress)
                                        : all_sources(tree_, level, groups.groups.size());
        const PatchLights lights(tree_, radiance_, 8);
        const std::vector<Moments> clusters = pull_moments(tree_, radiance_);
        const RayScene rays(scene_);
        return shoot({tree_, buffer, groups, sources, radiance_, interleave},
                     [&] {
                         return visibility_ == ShootingVisibility::kRays
                                    ? make_ray_shooter(tree_, lights, clusters, rays)
                                    : make_antiradiance_shooter(tree_, lights, table_, weights_,
                                                                1e-5F);
                     },
                     progress, {});
    }

    Scene scene_;
    ShootingVisibility visibility_ = ShootingVisibility::kAntiradiance;
    PatchTree tree_;
    std::vector<vec3> radiance_;
    DirectionBins bins_{128};
    BinWeights weights_{bins_, 64};
    AntiradianceTable table_;
};

class ShootingLevels
    : public Shooting,
      public testing::WithParamInterface<std::tuple<ShootingLevel, ShootingVisibility>> {};

TEST_P(ShootingLevels, a_room_of_radiance_1_brings_pi_everywhere) {
    const auto [level, visibility] = GetParam();
    visibility_ = visibility;
    set_unit_room();
    GBuffer buffer = test::empty_buffer(16, 16);
    for (std::uint32_t i = 0; i < 256; ++i) {
        const vec2 u = 0.004F + 0.992F * r2_sample(i, 3);  // into corners, but not past them
        const NodeId leaf = tree_.lookup(0, false, vec3(u, 0));
        buffer.fragments.push_back(test::make_fragment(i, vec3(u, 0), kUp, leaf));
    }
    ASSERT_EQ(tree_.normal[static_cast<std::size_t>(buffer.fragments[0].leaf)], kUp);
    // Leaves within two radii are exact; beyond, 8 points stand for a patch: 1 % each at most.
    for (const vec3& e : shoot_at(buffer, level))
        EXPECT_NEAR(e.x, kPi, 0.01F * kPi);
}

INSTANTIATE_TEST_SUITE_P(all, ShootingLevels,
                         testing::Combine(testing::Values(ShootingLevel::kLeaves,
                                                          ShootingLevel::kParents,
                                                          ShootingLevel::kCut),
                                          testing::Values(ShootingVisibility::kAntiradiance,
                                                          ShootingVisibility::kRays)));

// The unit square around the origin's axis at `height`, its front up or down.
PatchTree square_above(Scene& scene, float height, bool facing_up) {
    const int white = test::add_material(scene, vec3(0.5F));
    const vec3 x = facing_up ? vec3(1, 0, 0) : vec3(0, 1, 0);
    const vec3 y = facing_up ? vec3(0, 1, 0) : vec3(1, 0, 0);
    test::add_quad(scene, "square", vec3(-0.5F, -0.5F, height), x, y, white);
    return test::front_tree(scene, 9);
}

// Form factor of that square to a point at the origin: four times a rectangle's over its corner.
float square_form_factor(float height) {
    const float a = 0.5F / height;
    const float root = std::sqrt(1 + a * a);
    return 4 / (2 * kPi) * 2 * (a / root) * std::atan(a / root);
}

class ShootingHeights : public Shooting, public testing::WithParamInterface<float> {};

TEST_P(ShootingHeights, radiance_lights_what_lies_in_front) {
    set_tree(square_above(scene_, GetParam(), false));
    radiance_.assign(tree_.size(), vec3(2, 1, 0));
    table_.values.assign(table_.values.size(), vec3(5));
    GBuffer buffer = test::empty_buffer(1, 1);
    buffer.fragments.push_back(test::make_fragment(0, vec3(0), kUp));
    const vec3 e = shoot_at(buffer, ShootingLevel::kLeaves)[0];
    visibility_ = ShootingVisibility::kRays;
    const vec3 by_rays = shoot_at(buffer, ShootingLevel::kLeaves)[0];
    const float wanted = kPi * square_form_factor(GetParam());
    // Rays share out an exact form factor up to 4 radii (2.8 m), where the centre is 2.1 % off.
    EXPECT_NEAR(by_rays.x, 2 * wanted, (GetParam() < 2.8F ? 0.004F : 0.022F) * 2 * wanted);
    EXPECT_EQ(by_rays.z, 0);
    // Exact when near; of 8 points from 2 radii on, and of the centre alone from 8 radii on.
    EXPECT_NEAR(e.x, 2 * wanted, 0.04F * 2 * wanted);
    EXPECT_FLOAT_EQ(e.x, 2 * e.y);
    EXPECT_EQ(e.z, 0);
}

TEST_P(ShootingHeights, antiradiance_darkens_what_lies_behind) {
    set_tree(square_above(scene_, GetParam(), true));
    radiance_.assign(tree_.size(), vec3(5));
    table_.values.assign(table_.values.size(), vec3(2, 1, 0));
    GBuffer buffer = test::empty_buffer(1, 1);
    buffer.fragments.push_back(test::make_fragment(0, vec3(0), kUp));
    const vec3 e = shoot_at(buffer, ShootingLevel::kLeaves)[0];
    const float wanted = -kPi * square_form_factor(GetParam());
    EXPECT_NEAR(e.x, 2 * wanted, 0.04F * 2 * -wanted);
    EXPECT_EQ(e.z, 0);
}

INSTANTIATE_TEST_SUITE_P(all, ShootingHeights,
                         testing::Values(0.05F, 0.1F, 0.5F, 1.0F, 1.5F, 2.0F, 4.0F, 10.0F));

TEST_F(Shooting, rays_cast_the_shadow_of_what_stands_in_the_way) {
    visibility_ = ShootingVisibility::kRays;
    const int white = test::add_material(scene_, vec3(0.5F));
    // A unit square 2 m above the floor, facing down, and a slab 1 m below it that hides half of
    // it from the origin.
    test::add_quad(scene_, "source", vec3(-0.5F, -0.5F, 2), vec3(0, 1, 0), vec3(1, 0, 0), white);
    set_tree(test::front_tree(scene_, 0.2F));
    test::add_quad(scene_, "slab", vec3(-2, -2, 1), vec3(2, 0, 0), vec3(0, 4, 0), white);
    radiance_.assign(tree_.size(), vec3(1));
    GBuffer buffer = test::empty_buffer(3, 1);
    buffer.fragments.push_back(test::make_fragment(0, vec3(0), kUp));
    buffer.fragments.push_back(test::make_fragment(1, vec3(-1, 0, 0), kUp));  // sees none of it
    buffer.fragments.push_back(test::make_fragment(2, vec3(1, 0, 0), kUp));   // sees all of it
    const std::vector<vec3> e = shoot_at(buffer, ShootingLevel::kLeaves);
    const float open = kPi * square_form_factor(2);
    EXPECT_NEAR(e[0].x, open / 2, 0.01F * open);
    EXPECT_EQ(e[1].x, 0);
    EXPECT_GT(e[2].x, 0.5F * open);
}

TEST_F(Shooting, rays_start_where_a_patch_is_out_of_the_solids_that_stand_on_it) {
    visibility_ = ShootingVisibility::kRays;
    const int white = test::add_material(scene_, vec3(0.5F));
    test::add_quad(scene_, "wall", vec3(0), vec3(1, 0, 0), vec3(0, 1, 0), white);
    set_tree(test::front_tree(scene_, 2));
    // A box stands on its left half: two of the four columns of strata are buried.
    test::add_box(scene_, "box", vec3(-1, -1, -1), vec3(0.5F, 2, 0.1F), white,
                  test::Facing::kOutward);
    const NodeId leaf = tree_.leaves.front();
    std::uint16_t mask = 0;
    for (unsigned k = 0; k < 16; ++k) {
        const vec3 at = tree_.patch_point(leaf, (vec2(k % 4, k / 4) + 0.5F) / 4.0F);
        if (at.x > 0.5F) mask = static_cast<std::uint16_t>(mask | (1U << k));
    }
    tree_.exposed_mask[static_cast<std::size_t>(leaf)] = mask;
    tree_.exposed.assign(tree_.size(), 0.5F);
    radiance_.assign(tree_.size(), vec3(0.5F));  // the mean over buried and exposed parts
    GBuffer buffer = test::empty_buffer(1, 1);
    buffer.fragments.push_back(test::make_fragment(0, vec3(0.75F, 0.5F, 10), -kUp));
    // All of the wall's light arrives: none of the rays goes to its buried half.
    EXPECT_NEAR(shoot_at(buffer, ShootingLevel::kLeaves)[0].x, 0.5F / 100, 0.01F * 0.5F / 100);
}

TEST_F(Shooting, a_plane_does_not_light_itself) {
    const int white = test::add_material(scene_, vec3(0.5F));
    test::add_quad(scene_, "floor", vec3(0), vec3(1, 0, 0), vec3(0, 1, 0), white);
    test::add_quad(scene_, "next to it", vec3(1, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), white);
    set_tree(test::front_tree(scene_, 0.3F));
    radiance_.assign(tree_.size(), vec3(1));
    table_.values.assign(table_.values.size(), vec3(1));
    GBuffer buffer = test::empty_buffer(8, 8);
    for (std::uint32_t i = 0; i < 64; ++i) {
        const float rounding = i % 2 ? 1e-6F : -1e-6F;
        const vec3 at(2.0F * r2_sample(i, 1).x, r2_sample(i, 1).y, rounding);
        buffer.fragments.push_back(test::make_fragment(i, at, kUp));
    }
    for (const vec3& e : shoot_at(buffer, ShootingLevel::kLeaves))
        EXPECT_EQ(e, vec3(0));
}

TEST_F(Shooting, a_cut_holds_every_leaf_once_that_is_not_below_the_horizon) {
    set_unit_room();
    const GBuffer buffer = test::plane_buffer(32, 32, 0.03F);
    const FragmentGroups groups = tile_groups(buffer, vec3(0.5F), 8);
    Progress progress;
    const SourceLists lists = cut_sources(tree_, groups, CutRule{}, progress);
    std::size_t coarse = 0;
    for (std::size_t g = 0; g < groups.groups.size(); ++g) {
        std::vector<int> covered(tree_.size(), 0);
        for (const NodeId n : lists.of(g)) {
            coarse += tree_.is_leaf(n) ? 0 : 1;
            for (NodeId m = n; m < tree_.subtree_end[static_cast<std::size_t>(n)]; ++m)
                ++covered[static_cast<std::size_t>(m)];
        }
        for (const NodeId leaf : tree_.leaves) {
            const bool above = tree_.center[static_cast<std::size_t>(leaf)].z > 1e-6F;
            EXPECT_LE(covered[static_cast<std::size_t>(leaf)], 1);
            EXPECT_GE(covered[static_cast<std::size_t>(leaf)], above ? 1 : 0);
        }
    }
    EXPECT_GT(coarse, 0U);
}

TEST_F(Shooting, only_linked_sources_light_a_receiver_of_a_cut_mesh) {
    set_unit_room();
    const NodeId receiver = tree_.leaves.front();
    const NodeId source = tree_.parent[static_cast<std::size_t>(tree_.leaves.back())];
    ASSERT_FALSE(tree_.is_cluster(source));
    LinkSet links;
    links.bins = bins_;
    links.links = {{source, 0.1F}};
    links.segments = {{tree_.parent[static_cast<std::size_t>(receiver)], 0, 1, 1}};
    GBuffer buffer = test::empty_buffer(2, 1);
    buffer.fragments.push_back(
        test::make_fragment(0, tree_.center[static_cast<std::size_t>(receiver)],
                            tree_.normal[static_cast<std::size_t>(receiver)], receiver));
    buffer.fragments.push_back(test::make_fragment(1, vec3(0.5F), kUp, source + 1));
    const FragmentGroups groups = receiver_groups(buffer);
    ASSERT_EQ(groups.groups.size(), 2U);
    Progress progress;
    const SourceLists leaves =
        linked_sources(tree_, links, buffer, groups, ShootingLevel::kLeaves, CutRule{}, progress);
    EXPECT_EQ(leaves.of(0).size(), 4U);
    for (const NodeId n : leaves.of(0))
        EXPECT_EQ(tree_.parent[static_cast<std::size_t>(n)], source);
    EXPECT_TRUE(leaves.of(1).empty());
    const SourceLists parents =
        linked_sources(tree_, links, buffer, groups, ShootingLevel::kParents, CutRule{}, progress);
    ASSERT_EQ(parents.of(0).size(), 1U);
    EXPECT_EQ(parents.of(0)[0], source);
}

TEST_F(Shooting, interleaved_pixels_share_out_the_sources) {
    set_unit_room();
    GBuffer buffer = test::plane_buffer(16, 16, 0.002F);
    for (Fragment& f : buffer.fragments)
        f.position += vec3(0.5F, 0.5F, 0);  // the floor's middle, where light hardly changes
    const std::vector<vec3> exact = shoot_at(buffer, ShootingLevel::kLeaves);
    const std::vector<vec3> shared = shoot_at(buffer, ShootingLevel::kLeaves, 4);
    Progress progress;
    const std::vector<vec3> blurred = interleave_blur(buffer, shared, 4, progress);
    float worst_before = 0;
    for (int y = 2; y < 14; ++y) {
        for (int x = 2; x < 14; ++x) {
            const auto i = static_cast<std::size_t>(y * 16 + x);
            worst_before = std::max(worst_before, std::abs(shared[i].x / exact[i].x - 1));
            EXPECT_NEAR(blurred[i].x, exact[i].x, 0.01F * exact[i].x);
        }
    }
    EXPECT_GT(worst_before, 0.1F);
}

TEST_F(Shooting, near_and_far_sources_are_all_sources) {
    set_unit_room();
    const GBuffer buffer = test::plane_buffer(16, 16, 0.03F);
    const FragmentGroups groups = tile_groups(buffer, vec3(0.5F), 8);
    Progress progress;
    const SourceLists all = cut_sources(tree_, groups, CutRule{}, progress);
    const NearAndFar parts = split_near(tree_, groups, all, progress);
    for (std::size_t g = 0; g < groups.groups.size(); ++g) {
        std::vector<NodeId> joined(parts.near.of(g).begin(), parts.near.of(g).end());
        joined.insert(joined.end(), parts.far.of(g).begin(), parts.far.of(g).end());
        std::sort(joined.begin(), joined.end());
        EXPECT_TRUE(std::ranges::equal(joined, all.of(g)));
        EXPECT_FALSE(parts.near.of(g).empty());
        for (const NodeId n : parts.far.of(g)) {
            const auto i = static_cast<std::size_t>(n);
            EXPECT_GE(glm::distance(tree_.center[i], groups.groups[g].center),
                      4 * tree_.radius[i] + groups.groups[g].radius);
        }
    }
}

TEST(InterleaveBlur, stays_on_a_surface) {
    GBuffer buffer = test::plane_buffer(8, 8, 0.1F);
    std::vector<vec3> light(64, vec3(1));
    for (std::size_t i = 0; i < 64; ++i) {
        if (i % 8 < 4) continue;  // the right half is a wall, and bright
        buffer.fragments[i].normal = buffer.fragments[i].shading_normal = vec3(1, 0, 0);
        light[i] = vec3(100);
    }
    Progress progress;
    const std::vector<vec3> blurred = interleave_blur(buffer, light, 4, progress);
    for (std::size_t i = 0; i < 64; ++i)
        EXPECT_EQ(blurred[i].x, i % 8 < 4 ? 1 : 100);
}

TEST(TileGroups, hold_every_fragment_once_and_split_at_jumps) {
    GBuffer buffer = test::plane_buffer(20, 12, 0.1F);
    for (std::size_t i = 0; i < buffer.fragments.size(); ++i) {
        if (i % 20 >= 14) buffer.fragments[i].position.z = -5;  // seen over an edge
    }
    const FragmentGroups tiles = tile_groups(buffer, vec3(1, 0.6F, 2), 8);
    std::vector<int> seen(buffer.fragments.size(), 0);
    for (const FragmentGroup& group : tiles.groups) {
        for (std::uint32_t i = group.begin; i < group.end; ++i) {
            const Fragment& f = buffer.fragments[tiles.order[i]];
            ++seen[tiles.order[i]];
            EXPECT_LE(glm::distance(f.position, group.center), group.radius * 1.0001F);
            EXPECT_GE(glm::dot(f.shading_normal, group.normal), group.cone_cosine - 1e-6F);
        }
        EXPECT_LT(group.radius, 1.0F);
    }
    EXPECT_EQ(*std::min_element(seen.begin(), seen.end()), 1);
    EXPECT_EQ(*std::max_element(seen.begin(), seen.end()), 1);
}

TEST(Splatting, keeps_constants_and_smooths_steps) {
    Scene scene;
    const int white = test::add_material(scene, vec3(0.5F));
    test::add_quad(scene, "floor", vec3(0), vec3(1, 0, 0), vec3(0, 1, 0), white);
    const PatchTree tree = test::front_tree(scene, 0.13F);
    const GBuffer buffer = test::plane_buffer(48, 48, 1.0F / 48);
    const FragmentGroups tiles = tile_groups(buffer, vec3(0.5F, 0.5F, 3), 8);
    Progress progress;
    const std::vector<vec3> constant(tree.size(), vec3(3));
    const SourceLists disks = find_disks(tree, tiles, progress);
    for (const vec3& e : splat({tree, constant, buffer, tiles, disks}, progress, {}))
        EXPECT_NEAR(e.x, 3, 1e-5F);

    std::vector<vec3> ramp(tree.size());
    for (std::size_t n = 0; n < tree.size(); ++n)
        ramp[n] = vec3(tree.center[n].x);
    const std::vector<vec3> smooth = splat({tree, ramp, buffer, tiles, disks}, progress, {});
    for (int y = 8; y < 40; ++y) {
        for (int x = 9; x < 39; ++x) {
            const auto i = static_cast<std::size_t>(y * 48 + x);
            EXPECT_NEAR(smooth[i].x, buffer.fragments[i].position.x, 0.02F);  // a patch is 0.125
        }
    }
}

}  // namespace
}  // namespace antiradiance
