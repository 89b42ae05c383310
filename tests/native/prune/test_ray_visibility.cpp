// SPDX-License-Identifier: GPL-3.0-or-later
#include "prune/ray_visibility.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hand_made_links.h"

namespace antiradiance {
namespace {

using test::HandMadeLinks;

const vec3 kX(1, 0, 0);
const vec3 kY(0, 1, 0);
const vec3 kZ(0, 0, 1);

// All scenes below are 2 m wide.
constexpr float kEpsilon = 2e-5F;

struct Made : HandMadeLinks {
    // Parallelogram whose front looks along cross(a, b).
    void add(const std::string& name, const vec3& corner, const vec3& a, const vec3& b) {
        test::add_quad(scene, name, corner, a, b, 0);
    }
    // Of the + or - link from "S" to "R".
    LinkVisibility visibility(bool behind = false, BlockingSides sides = BlockingSides::kAny) {
        make_tree();
        raw.clear();
        behind ? minus(node("S"), node("R")) : plus(node("S"), node("R"));
        const RayScene rays(scene);
        EXPECT_FLOAT_EQ(rays.epsilon(), kEpsilon);
        Progress progress;
        return trace_visibility(scene, tree, links(), rays, {.blocking_sides = sides}, progress)
            .at(0);
    }
};

// S, a wall at x = -1, looks at a strip of floor R behind a screen that stands at x = 0 and leans
// by an angle towards the strip.
Made strip_behind_screen(float lift, float angle, bool screen_faces_strip = true,
                         bool looks_at_strip = true) {
    const float width = 20 * kEpsilon;
    Made made;
    const vec3 foot(0, -1, lift);
    const vec3 up(std::sin(angle), 0, std::cos(angle));
    if (screen_faces_strip)
        made.add("Screen", foot, 2.0F * kY, up);
    else
        made.add("Screen", foot, up, 2.0F * kY);
    made.add("R", {0, -0.5F, 0}, width * kX, kY);
    const vec3 low(-1, -0.5F, 0.1F);
    if (looks_at_strip)
        made.add("S", low, kY, 0.8F * kZ);
    else
        made.add("S", low, 0.8F * kZ, kY);
    return made;
}

TEST(TraceVisibility, NoRayStepsOverTheFootOfAWall) {
    // A ray that leaves out epsilon at its ends meets no wall nearer than that.
    EXPECT_EQ(strip_behind_screen(0, 0).visibility(), LinkVisibility::kNone);
    EXPECT_EQ(strip_behind_screen(1e-3F, 0).visibility(), LinkVisibility::kFull)
        << "light comes in below";
}

TEST(TraceVisibility, NoRayStartsBeyondALeaningSheet) {
    // A point below it that is lifted off the floor by two epsilon would lie above it.
    const float angle = kPi * 80 / 180;
    EXPECT_EQ(strip_behind_screen(0, angle).visibility(), LinkVisibility::kNone);
    EXPECT_EQ(strip_behind_screen(1e-3F, angle).visibility(), LinkVisibility::kFull);
}

TEST(TraceVisibility, AntiradianceStepsOverNoFootEither) {
    EXPECT_EQ(strip_behind_screen(0, 0, true, false).visibility(true), LinkVisibility::kNone);
    EXPECT_EQ(strip_behind_screen(1e-3F, 0, true, false).visibility(true), LinkVisibility::kFull);
}

TEST(TraceVisibility, AntiradianceLeavesSolidsIfToldSo) {
    // It meets the screen's back, or its front.
    EXPECT_EQ(strip_behind_screen(0, 0, true, false).visibility(true, BlockingSides::kFacing),
              LinkVisibility::kFull);
    EXPECT_EQ(strip_behind_screen(0, 0, false, false).visibility(true, BlockingSides::kFacing),
              LinkVisibility::kNone);
}

TEST(TraceVisibility, AStripThinnerThanEpsilonLiesOnOneSideOfItsFoot) {
    // S stands on a board and R below it.
    for (const float thickness : {2 * kEpsilon, 0.5F * kEpsilon, 0.01F * kEpsilon}) {
        Made made;
        made.add("Board", {0, -1, 0.5F}, kX, 2.0F * kY);
        made.add("S", {0.5F, -0.5F, 0.5F}, kY, thickness * kZ);
        made.add("R", {1.5F, -0.5F, 0}, 0.4F * kZ, kY);
        EXPECT_EQ(made.visibility(), LinkVisibility::kNone) << thickness;
    }
}

TEST(TraceVisibility, SurfacesThatHoldAnEndHideNothing) {
    Made corner;  // a wall and the floor share an edge
    corner.add("S", {0, -1, 0}, 2.0F * kY, kZ);
    corner.add("R", {0, -1, 0}, kX, 2.0F * kY);
    EXPECT_EQ(corner.visibility(), LinkVisibility::kFull);

    Made sheet;  // of paper, and the floor that it lies on
    sheet.add("S", {0, -1, 0}, 2.0F * kY, kZ);
    sheet.add("R", {0.2F, -1, 0}, kX, 2.0F * kY);
    sheet.add("Paper", {0.3F, -0.5F, 0}, 0.5F * kX, kY);
    EXPECT_EQ(sheet.visibility(), LinkVisibility::kFull);
}

TEST(TraceVisibility, PartialWhereSomeRaysArrive) {
    Made made;
    made.add("S", {-1, -1, 0}, 2.0F * kY, kZ);
    made.add("Half", {0, -1, 0}, 2.0F * kY, 0.5F * kZ);
    made.add("R", {1, -1, 0}, kZ, 2.0F * kY);
    EXPECT_EQ(made.visibility(), LinkVisibility::kPartial);
}

TEST(TraceVisibility, BackToBackCarriesNothing) {
    Made made;
    made.add("S", {0, -1, 0}, kZ, 2.0F * kY);
    made.add("R", {1, -1, 0}, 2.0F * kY, kZ);
    EXPECT_EQ(made.visibility(), LinkVisibility::kNone);
}

}  // namespace
}  // namespace antiradiance
