// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/picture_levels.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace antiradiance {

namespace {

constexpr double kFrame = 1.0 / 20;  // s, that a navigation picture may take
constexpr float kLeastShare = 1.0F / 8;
constexpr float kShares = 32;
constexpr double kFirstPixels = 40000;  // of the first navigation picture, whose pace is unknown
constexpr double kNewest = 0.3;         // weight of the newest picture's pace

constexpr int kInterleave = 4;
constexpr int kInterleavedSamples = 2;  // anti-aliasing, per axis
constexpr int kInterleavedDirect = 4;   // shadow rays for each light of a pixel

DisplayOptions quick_options(DisplayOptions options) {
    if (options.mode == DisplayMode::kFinalShooting) options.mode = DisplayMode::kSplatting;
    return options;
}

DisplayOptions interleaved_options(DisplayOptions options) {
    options.interleave = std::max(options.interleave, kInterleave);
    options.direct_samples = std::min(options.direct_samples, kInterleavedDirect);
    return options;
}

}  // namespace

std::string_view name_of(LevelName level) {
    switch (level) {
        case LevelName::kNavigation:
            return "NAVIGATION";
        case LevelName::kQuick:
            return "QUICK";
        case LevelName::kInterleaved:
            return "INTERLEAVED";
        case LevelName::kFinal:
            return "FINAL";
    }
    throw std::logic_error("a level without a name");
}

std::vector<PictureLevel> picture_levels(const Options& options) {
    const DisplayOptions final = options.resolved_display();
    constexpr PictureQuality kQuick{.samples_per_axis = 1, .direct_of_leaves = true};
    std::vector<PictureLevel> levels{{LevelName::kNavigation, quick_options(final), kQuick},
                                     {LevelName::kQuick, quick_options(final), kQuick}};
    if (final.mode == DisplayMode::kFinalShooting) {
        levels.push_back({LevelName::kInterleaved,
                          interleaved_options(final),
                          {.samples_per_axis = kInterleavedSamples}});
    }
    levels.push_back({LevelName::kFinal, final, {}});
    return levels;
}

std::vector<PictureLevel> inspection_levels() {
    return {{LevelName::kNavigation, {}, {.samples_per_axis = 1}},
            {LevelName::kFinal, {}, {.samples_per_axis = 2}}};
}

Camera scaled(const Camera& camera, float share) {
    // The border's own pixels are scaled, and the view frame is cut to the border: so it stays
    // exactly what it is, whatever pixels a scaled full frame would have.
    const auto part = [&](float low, float high, int pixel, int pixels) {
        return low + (high - low) * static_cast<float>(pixel) / static_cast<float>(pixels);
    };
    const auto reduced = [&](int pixels) {
        return std::max(1, static_cast<int>(std::lround(static_cast<float>(pixels) * share)));
    };
    Camera result = camera;
    result.left = part(camera.left, camera.right, camera.x0, camera.width);
    result.right = part(camera.left, camera.right, camera.x1, camera.width);
    result.bottom = part(camera.bottom, camera.top, camera.y0, camera.height);
    result.top = part(camera.bottom, camera.top, camera.y1, camera.height);
    result.x0 = result.y0 = 0;
    result.width = result.x1 = reduced(camera.x1 - camera.x0);
    result.height = result.y1 = reduced(camera.y1 - camera.y0);
    return result;
}

float NavigationPace::share(double pixels) const {
    const double affordable = seconds_per_pixel_ > 0 ? kFrame / seconds_per_pixel_ : kFirstPixels;
    const auto side = static_cast<float>(std::sqrt(affordable / std::max(pixels, 1.0)));
    return std::clamp(std::floor(side * kShares) / kShares, kLeastShare, 1.0F);
}

void NavigationPace::add(double pixels, double seconds) {
    const double pace = seconds / std::max(pixels, 1.0);
    seconds_per_pixel_ =
        seconds_per_pixel_ > 0 ? kNewest * pace + (1 - kNewest) * seconds_per_pixel_ : pace;
}

}  // namespace antiradiance
