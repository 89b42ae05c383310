// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "display/gbuffer.h"

namespace antiradiance {

// Fragments that are lit together, by one list of sources.
struct FragmentGroup {
    std::uint32_t begin = 0, end = 0;  // into FragmentGroups::order
    vec3 center{0};                    // m, of a sphere around the fragments
    float radius = 0;                  // m
    vec3 normal{0};                    // unit, mean
    float cone_cosine = -1;            // all normals lie within this angle's cosine of `normal`
};

struct FragmentGroups {
    std::vector<std::uint32_t> order;  // #fragments, into GBuffer::fragments
    std::vector<FragmentGroup> groups;
};

// Square tiles of the picture (pixels along a side), split where depth jumps or where surfaces turn
// to another side of the world's axes.
[[nodiscard]] FragmentGroups tile_groups(const GBuffer& buffer, const vec3& eye, int tile_size);

// The fragments of one leaf each; those without a leaf are left out.
[[nodiscard]] FragmentGroups receiver_groups(const GBuffer& buffer);

}  // namespace antiradiance
