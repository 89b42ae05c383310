// SPDX-License-Identifier: GPL-3.0-or-later
// G-buffers without a camera.
#pragma once

#include "display/gbuffer.h"

namespace antiradiance::test {

// `width` x `height` pixels without a fragment.
inline GBuffer empty_buffer(int width, int height) {
    GBuffer buffer;
    buffer.width = width;
    buffer.height = height;
    const auto pixels = static_cast<std::size_t>(width * height);
    buffer.background.resize(pixels);
    buffer.depth.resize(pixels);
    buffer.normal.resize(pixels);
    return buffer;
}

// Fills the whole pixel.
inline Fragment make_fragment(std::uint32_t pixel, const vec3& position, const vec3& normal,
                              NodeId leaf = kNone) {
    Fragment f;
    f.pixel = pixel;
    f.leaf = leaf;
    f.coverage = 1;
    f.position = position;
    f.normal = f.shading_normal = normal;
    f.albedo = vec3(1);
    return f;
}

// A horizontal plane: the pixels' points lie `spacing` m apart from (0, 0, 0) on and face up.
inline GBuffer plane_buffer(int width, int height, float spacing) {
    GBuffer buffer = empty_buffer(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x)
            buffer.fragments.push_back(make_fragment(static_cast<std::uint32_t>(y * width + x),
                                                     vec3(x, y, 0) * spacing, vec3(0, 0, 1)));
    }
    return buffer;
}

}  // namespace antiradiance::test
