// SPDX-License-Identifier: GPL-3.0-or-later
// Rasterising into depth images. As for gl_objects.h: on the context's thread only.
#pragma once

#include "gpu/gl_objects.h"

namespace antiradiance::gpu {

void delete_texture(std::uint32_t name);
void delete_framebuffer(std::uint32_t name);
void delete_vertex_array(std::uint32_t name);

// A stack of square images of 32-bit float depth.
class DepthImages {
public:
    DepthImages() = default;
    // size: pixels along a side. Throws GlError when the device has no room or no such many layers.
    DepthImages(int size, int layers);

    [[nodiscard]] int size() const { return size_; }
    [[nodiscard]] std::size_t bytes() const;

    // Fills a layer with the triangles that `program` makes from the numbers of `vertices`
    // vertices. Depth is reversed: clip space is 0..w along z, the largest depth wins, nothing
    // leaves 0. With near / distance as the depth, a float keeps its relative precision at any
    // distance.
    void draw(int layer, const Program& program, std::size_t vertices) const;

    void bind(int unit) const;  // as a sampler2DArray for texelFetch()

private:
    int size_ = 0;
    int layers_ = 0;
    Name<delete_texture> texture_;
    Name<delete_framebuffer> framebuffer_;
    Name<delete_vertex_array> vertex_array_;  // without attributes; OpenGL draws nothing without
};

}  // namespace antiradiance::gpu
