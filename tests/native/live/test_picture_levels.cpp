// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/picture_levels.h"

#include <gtest/gtest.h>

#include "display/camera_rays.h"

namespace antiradiance {
namespace {

std::vector<LevelName> names(DisplayMode mode) {
    Options options;
    options.display = mode;
    std::vector<LevelName> result;
    for (const PictureLevel& level : picture_levels(options))
        result.push_back(level.name);
    return result;
}

TEST(PictureLevels, EndWithWhatARenderMakes) {
    for (const DisplayMode mode :
         {DisplayMode::kPatches, DisplayMode::kSplatting, DisplayMode::kFinalShooting}) {
        Options options;
        options.display = mode;
        options.interleave = 2;
        const PictureLevel last = picture_levels(options).back();
        EXPECT_EQ(last.name, LevelName::kFinal);
        EXPECT_EQ(last.options, options.resolved_display());
        EXPECT_EQ(last.quality.samples_per_axis, PictureQuality{}.samples_per_axis);
        EXPECT_FALSE(last.quality.direct_of_leaves);
    }
}

TEST(PictureLevels, OnlyFinalShootingIsInterleavedBefore) {
    using enum LevelName;
    EXPECT_EQ(names(DisplayMode::kFinalShooting),
              (std::vector{kNavigation, kQuick, kInterleaved, kFinal}));
    EXPECT_EQ(names(DisplayMode::kPatches), (std::vector{kNavigation, kQuick, kFinal}));
}

Camera wide_camera() {
    return {.left = -2,
            .right = 1,
            .bottom = -1,
            .top = 0.5F,
            .width = 600,
            .height = 300,
            .x0 = 100,
            .y0 = 30,
            .x1 = 500,
            .y1 = 270};
}

TEST(Scaled, ShowsExactlyTheBorder) {
    const Camera camera = wide_camera();
    for (const float share : {1.0F, 0.5F, 0.13F}) {
        const Camera small = scaled(camera, share);
        EXPECT_EQ(small.x1, std::lround(400 * share));
        EXPECT_EQ(small.y1, std::lround(240 * share));
        const CameraRays whole(camera);
        const CameraRays few(small);
        const auto expect_same = [](const CameraRay& a, const CameraRay& b) {
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_NEAR(a.direction[axis], b.direction[axis], 1e-6F);
        };
        expect_same(whole.at({100, 30}), few.at({0, 0}));
        expect_same(whole.at({500, 270}),
                    few.at({static_cast<float>(small.x1), static_cast<float>(small.y1)}));
    }
}

TEST(Scaled, KeepsAPixel) {
    const Camera small = scaled(wide_camera(), 1e-4F);
    EXPECT_EQ(small.width, 1);
    EXPECT_EQ(small.height, 1);
}

TEST(NavigationPace, FindsThePixelsThatFitIntoAFrame) {
    constexpr double kPixels = 1280 * 720;
    constexpr double kPace = 4 * 0.05 / kPixels;  // s a pixel: a quarter fits into 1/20 s
    NavigationPace pace;
    EXPECT_LT(pace.share(kPixels), 1.0F) << "careful at first";
    for (int i = 0; i < 20; ++i) {
        const double pixels = kPixels * pace.share(kPixels) * pace.share(kPixels);
        pace.add(pixels, pixels * kPace);
    }
    EXPECT_FLOAT_EQ(pace.share(kPixels), 0.5F);
    EXPECT_FLOAT_EQ(pace.share(kPixels / 16), 1.0F) << "never more than there are";
    EXPECT_FLOAT_EQ(pace.share(kPixels * 1e6), 0.125F) << "never fewer than can be made out";
}

}  // namespace
}  // namespace antiradiance
