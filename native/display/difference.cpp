// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/difference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/srgb.h"

namespace antiradiance {

namespace {

std::string size_of(const PictureView& view) {
    return std::to_string(view.width) + " x " + std::to_string(view.height);
}

void check_size(const PictureView& first, const PictureView& second) {
    if (first.width != second.width || first.height != second.height) {
        throw SceneError("The pictures differ in size: " + size_of(first) + " and " +
                         size_of(second) + " pixels; render both at one resolution");
    }
}

void check_finite(const PictureView& view, const std::string& which) {
    const auto broken = std::ranges::count_if(
        view.pixels, [](const vec4& p) { return !std::isfinite(luminance(vec3(p))); });
    if (broken > 0) {
        throw SceneError("The " + which + " picture has " + std::to_string(broken) +
                         " pixels that are no finite numbers: render it again");
    }
}

// Signed, of what a display shows, -1..1.
vec4 colour_of(float difference) {
    const float shown = decode_srgb(kDifferenceScale * std::abs(difference));
    return difference < 0 ? vec4(shown, 0, 0, 1) : vec4(0, shown, 0, 1);
}

}  // namespace

Difference luminance_difference(const PictureView& first, const PictureView& second) {
    check_size(first, second);
    check_finite(first, "first");
    check_finite(second, "second");
    Difference result;
    result.picture.width = first.width;
    result.picture.height = first.height;
    result.picture.combined.reserve(first.pixels.size());
    double sum_first = 0;
    double sum_second = 0;
    double squares = 0;
    for (std::size_t i = 0; i < first.pixels.size(); ++i) {
        const float a = luminance(vec3(first.pixels[i]));
        const float b = luminance(vec3(second.pixels[i]));
        result.picture.combined.push_back(colour_of(encode_srgb(b) - encode_srgb(a)));
        const double difference = static_cast<double>(b) - static_cast<double>(a);
        sum_first += a;
        sum_second += b;
        squares += difference * difference;
        result.largest = std::max(result.largest, std::abs(difference));
    }
    const auto count = static_cast<double>(first.pixels.size());
    if (count == 0) return result;
    result.mean_first = sum_first / count;
    result.mean_second = sum_second / count;
    const double rms = std::sqrt(squares / count);
    result.relative_rms = rms == 0                ? 0
                          : result.mean_first > 0 ? rms / result.mean_first
                                                  : std::numeric_limits<double>::infinity();
    return result;
}

}  // namespace antiradiance
