#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// Eq. 3 at a leaf: L = source + albedo / pi E, with the irradiance of all patches it is a part of.
#include "shared/items.glsl"
#include "shared/nodes.glsl"
#include "shared/pass_state.glsl"

layout(local_size_x = kWorkGroupSize) in;
layout(location = kRelaxationLocation) uniform float relaxation;
layout(std430, binding = kLeavesBinding) readonly buffer Leaves { Leaf leaves[]; };
layout(std430, binding = kRadianceBinding) buffer Radiance { vec4 radiance[]; };
layout(std430, binding = kIrradianceBinding) buffer Irradiance { vec4 irradiance[]; };
layout(std430, binding = kStateBinding) writeonly buffer State { PassState states[]; };

shared PassState partial[kWorkGroupSize];

PassState reflect_leaf(Leaf leaf) {
    vec3 e = vec3(0.0);
    for (int n = leaf.node; is_patch(n); n = nodes[n].parent) e += irradiance[n].rgb;
    e *= leaf.row_scale;
    // No other leaf reads this one's place.
    irradiance[leaf.node] = vec4(e, 0.0);
    vec4 old = radiance[leaf.node];
    vec3 reflected = max(leaf.source + leaf.reflectance * e, vec3(0.0));
    vec3 relaxed = mix(old.rgb, reflected, relaxation);
    radiance[leaf.node] = vec4(relaxed, old.w);
    vec3 change = abs(reflected - old.rgb);
    return PassState(relaxed, max(change.r, max(change.g, change.b)),
                     abs(reflected - leaf.source), 0.0);
}

void main() {
    uint item;
    uint lane = gl_LocalInvocationID.x;
    partial[lane] = kNothing;
    if (select_item(item)) partial[lane] = reflect_leaf(leaves[item]);
    for (uint half_size = uint(kWorkGroupSize) / 2u; half_size > 0u; half_size /= 2u) {
        barrier();
        if (lane < half_size) {
            partial[lane] = largest(partial[lane], partial[lane + half_size]);
        }
    }
    if (lane == 0u) {
        uint group = first_item / uint(kWorkGroupSize) + gl_WorkGroupID.x;
        states[1u + group] = partial[0];
    }
}
