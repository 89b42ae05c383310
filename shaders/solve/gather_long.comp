#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// One work group a segment, for segments so long that one invocation would keep its neighbours
// waiting.
#include "shared/gather_links.glsl"

layout(local_size_x = kWorkGroupSize) in;

shared vec3 partial_sums[kWorkGroupSize];

void main() {
    if (gl_WorkGroupID.x >= item_count) return;  // the same for the whole work group
    uint segment = first_item + gl_WorkGroupID.x;
    uint lane = gl_LocalInvocationID.x;
    partial_sums[lane] = gather_links(segments[segment], lane, uint(kWorkGroupSize));
    for (uint half_size = uint(kWorkGroupSize) / 2u; half_size > 0u; half_size /= 2u) {
        barrier();
        if (lane < half_size) partial_sums[lane] += partial_sums[lane + half_size];
    }
    if (lane == 0u) store_flux(segment, partial_sums[0]);
}
