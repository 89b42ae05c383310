#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// The largest of what reflect's work groups found; one work group.
#include "shared/items.glsl"
#include "shared/pass_state.glsl"

layout(local_size_x = kReduceGroupSize) in;
layout(std430, binding = kStateBinding) buffer State { PassState states[]; };

shared PassState partial[kReduceGroupSize];

void main() {
    uint lane = gl_LocalInvocationID.x;
    PassState mine = kNothing;
    for (uint i = first_item + lane; i < first_item + item_count; i += uint(kReduceGroupSize)) {
        mine = largest(mine, states[i]);
    }
    partial[lane] = mine;
    for (uint half_size = uint(kReduceGroupSize) / 2u; half_size > 0u; half_size /= 2u) {
        barrier();
        if (lane < half_size) {
            partial[lane] = largest(partial[lane], partial[lane + half_size]);
        }
    }
    if (lane == 0u) states[0] = partial[0];
}
