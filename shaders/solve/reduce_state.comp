#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// The largest of what reflect's work groups found; one work group.
#include "shared/items.glsl"

layout(local_size_x = kReduceGroupSize) in;
layout(std430, binding = kStateBinding) buffer State { PassState states[]; };

shared vec4 partial_max[kReduceGroupSize];

void main() {
    uint lane = gl_LocalInvocationID.x;
    vec4 largest = vec4(0.0);
    for (uint i = first_item + lane; i < first_item + item_count; i += uint(kReduceGroupSize)) {
        largest = max(largest, vec4(states[i].max_radiance, states[i].max_change));
    }
    partial_max[lane] = largest;
    for (uint half_size = uint(kReduceGroupSize) / 2u; half_size > 0u; half_size /= 2u) {
        barrier();
        if (lane < half_size) {
            partial_max[lane] = max(partial_max[lane], partial_max[lane + half_size]);
        }
    }
    if (lane == 0u) states[0] = PassState(partial_max[0].rgb, partial_max[0].w);
}
