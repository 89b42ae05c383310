// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/shared_receivers.h"

#include <gtest/gtest.h>

#include "display/made_fragments.h"
#include "support/scene_builder.h"
#include "support/tree_builder.h"

namespace antiradiance {
namespace {

constexpr vec3 kUp(0, 0, 1);
const vec3 kPoint(0.3F, 0.4F, 0);

// A floor, a second one far below it, and three pixels in a row. The floor fills the first one.
class Sharing : public testing::Test {
protected:
    Sharing() {
        const int white = test::add_material(scene_, vec3(0.5F));
        test::add_quad(scene_, "floor", vec3(0), vec3(1, 0, 0), vec3(0, 1, 0), white);
        test::add_quad(scene_, "cellar", vec3(0, 0, -3), vec3(1, 0, 0), vec3(0, 1, 0), white);
        tree_ = test::front_tree(scene_, 0.3F);
        buffer_ = test::empty_buffer(3, 1);
        add(0, 1, kPoint);
    }
    Fragment& add(std::uint32_t pixel, float coverage, const vec3& position) {
        const TriangleId triangle = position.z < 0 ? 2 : 0;
        const NodeId leaf = tree_.lookup(triangle, false, position);
        Fragment& f =
            buffer_.fragments.emplace_back(test::make_fragment(pixel, position, kUp, leaf));
        f.coverage = coverage;
        return f;
    }
    [[nodiscard]] SharedReceivers shared() const { return share_receivers(tree_, buffer_); }
    [[nodiscard]] vec3 beside(float x) const { return kPoint + vec3(x, 0, 0); }

    Scene scene_;
    PatchTree tree_;
    GBuffer buffer_;
};

TEST_F(Sharing, small_fragment_takes_the_light_of_the_pixel_beside) {
    add(1, 0.3F, beside(0.01F));
    add(1, 0.7F, vec3(0.3F, 0.4F, -3));
    const SharedReceivers s = shared();
    EXPECT_EQ(s.of, (std::vector<std::uint32_t>{0, 0, 1}));
    ASSERT_EQ(s.receivers.fragments.size(), 2U);
    const std::vector<vec3> light{vec3(1), vec3(2)};
    EXPECT_EQ(s.spread(light), (std::vector<vec3>{vec3(1), vec3(1), vec3(2)}));
}

TEST_F(Sharing, a_fragment_that_comes_first_may_share_with_a_later_one) {
    buffer_.fragments.clear();
    add(0, 0.3F, kPoint);
    add(1, 1, beside(0.01F));
    EXPECT_EQ(shared().of, (std::vector<std::uint32_t>{0, 0}));
}

TEST_F(Sharing, most_of_a_pixel_is_lit_by_itself) {
    add(1, 0.6F, beside(0.01F));
    EXPECT_EQ(shared().of, (std::vector<std::uint32_t>{0, 1}));
}

TEST_F(Sharing, not_from_two_pixels_away) {
    add(2, 0.3F, beside(0.01F));
    EXPECT_EQ(shared().of, (std::vector<std::uint32_t>{0, 1}));
}

TEST_F(Sharing, not_with_another_surface) {
    add(1, 0.3F, vec3(0.3F, 0.4F, -3));
    EXPECT_EQ(shared().of, (std::vector<std::uint32_t>{0, 1}));
}

TEST_F(Sharing, not_where_the_surface_turns) {
    add(1, 0.3F, beside(0.01F)).shading_normal = glm::normalize(vec3(0.2F, 0, 1));
    EXPECT_EQ(shared().of, (std::vector<std::uint32_t>{0, 1}));
}

TEST_F(Sharing, not_beyond_a_leaf) {
    add(1, 0.3F, beside(0.6F));
    EXPECT_EQ(shared().of, (std::vector<std::uint32_t>{0, 1}));
}

}  // namespace
}  // namespace antiradiance
