// SPDX-License-Identifier: GPL-3.0-or-later
// Difference pictures of a few pixels, worked out by hand.
#include "display/difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/srgb.h"

namespace antiradiance {
namespace {

vec4 grey(float value) {
    return {value, value, value, 1};
}

Difference difference(const std::vector<vec4>& first, const std::vector<vec4>& second) {
    const auto view = [](const std::vector<vec4>& pixels) {
        return PictureView{static_cast<int>(pixels.size()), 1, pixels};
    };
    return luminance_difference(view(first), view(second));
}

TEST(Srgb, HasTheStandardsValues) {
    // 18 % grey is 118 of 255; the curve is a straight line of slope 12.92 near black.
    EXPECT_NEAR(encode_srgb(0.18F) * 255, 118, 0.5F);
    EXPECT_FLOAT_EQ(encode_srgb(0.001F), 0.01292F);
    EXPECT_FLOAT_EQ(encode_srgb(1), 1);
    EXPECT_EQ(encode_srgb(-1), 0);
    EXPECT_FLOAT_EQ(encode_srgb(7), 1);
    for (const float x : {0.0F, 0.002F, 0.02F, 0.4F, 1.0F})
        EXPECT_NEAR(decode_srgb(encode_srgb(x)), x, 1e-6F);
}

TEST(Difference, IsRedWhereTheSecondIsDarkerAndGreenWhereItIsBrighter) {
    // Shown as .5, .6 and .4: differences of .1, four times of which are shown as .4.
    const float half = decode_srgb(0.5F);
    const std::vector<vec4> pixels =
        difference({grey(half), grey(half), grey(half)},
                   {grey(half), grey(decode_srgb(0.6F)), grey(decode_srgb(0.4F))})
            .picture.combined;
    const float shown = decode_srgb(0.4F);
    const vec4 wanted[] = {vec4(0, 0, 0, 1), vec4(0, shown, 0, 1), vec4(shown, 0, 0, 1)};
    ASSERT_EQ(pixels.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        for (int c = 0; c < 4; ++c)
            EXPECT_NEAR(pixels[i][c], wanted[i][c], 1e-5F) << i;
    }
}

TEST(Difference, IsOfLuminanceAndEndsAtFullColour) {
    // Red of .7152 / .2126 times the green is as bright as the green.
    const std::vector<vec4> pixels = difference({vec4(0, 0.1F, 0, 1), grey(0)},
                                                {vec4(0.1F * 0.7152F / 0.2126F, 0, 0, 1), grey(1)})
                                         .picture.combined;
    EXPECT_NEAR(pixels[0].x + pixels[0].y, 0, 1e-5F);
    EXPECT_EQ(pixels[1], vec4(0, 1, 0, 1));
}

TEST(Difference, BeyondWhiteIsInTheFiguresOnly) {
    const Difference d = difference({grey(2)}, {grey(5)});
    EXPECT_EQ(d.picture.combined[0], vec4(0, 0, 0, 1));
    EXPECT_NEAR(d.largest, 3, 1e-6);
}

TEST(Difference, FiguresOfThreePixels) {
    const Difference d = difference({grey(1), grey(2), grey(3)}, {grey(1), grey(1), grey(5)});
    EXPECT_NEAR(d.mean_first, 2, 1e-6);
    EXPECT_NEAR(d.mean_second, 7.0 / 3, 1e-6);
    EXPECT_NEAR(d.relative_rms, std::sqrt(5.0 / 3) / 2, 1e-6);
    EXPECT_NEAR(d.largest, 2, 1e-6);
}

TEST(Difference, OfABlackPictureHasNoScale) {
    EXPECT_EQ(difference({grey(0)}, {grey(0)}).relative_rms, 0);
    EXPECT_TRUE(std::isinf(difference({grey(0)}, {grey(1)}).relative_rms));
}

std::string error_of(const PictureView& first, const PictureView& second) {
    try {
        static_cast<void>(luminance_difference(first, second));
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

TEST(Difference, NamesBothSizes) {
    const std::vector<vec4> pixels(6, grey(1));
    const std::string error = error_of({3, 2, pixels}, {2, 3, pixels});
    EXPECT_NE(error.find("3 x 2"), std::string::npos) << error;
    EXPECT_NE(error.find("2 x 3"), std::string::npos) << error;
}

TEST(Difference, SaysWhichPictureIsBroken) {
    const std::vector<vec4> sound{grey(1), grey(1)};
    const std::vector<vec4> broken{grey(1), grey(std::numeric_limits<float>::quiet_NaN())};
    EXPECT_NE(error_of({2, 1, sound}, {2, 1, broken}).find("second picture has 1"),
              std::string::npos);
    EXPECT_NE(error_of({2, 1, broken}, {2, 1, sound}).find("first picture has 1"),
              std::string::npos);
}

}  // namespace
}  // namespace antiradiance
