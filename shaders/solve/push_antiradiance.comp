#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// Adds the own antiradiance of a patch and of the patches that it is a part of to what
// pull_antiradiance left, and clamps: what passes through a patch is light, at most the brightest
// there is. Without the clamp the iteration can diverge. x: nodes, y: the bins of the batch.
#include "shared/items.glsl"
#include "shared/nodes.glsl"

layout(local_size_x = kWorkGroupSize) in;
layout(location = kNodeCountLocation) uniform uint node_count;
layout(std430, binding = kOwnAntiradianceBinding) readonly buffer OwnAntiradiance { vec4 own[]; };
layout(std430, binding = kAntiradianceBinding) buffer Antiradiance { vec4 antiradiance[]; };
layout(std430, binding = kStateBinding) readonly buffer State { PassState states[]; };

void main() {
    uint item;
    if (!select_item(item)) return;
    int node = int(item);
    if (!is_patch(node)) return;
    uint bin = gl_WorkGroupID.y * node_count;
    vec3 total = is_leaf(node) ? vec3(0.0) : antiradiance[bin + item].rgb;
    for (int n = node; is_patch(n); n = nodes[n].parent) total += own[bin + uint(n)].rgb;
    antiradiance[bin + item] = vec4(clamp(total, vec3(0.0), states[0].max_radiance), 0.0);
}
