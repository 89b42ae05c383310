#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// Radiance of the inner patches of one level: the area average of their parts.
#include "shared/items.glsl"
#include "shared/nodes.glsl"

layout(local_size_x = kWorkGroupSize) in;
layout(std430, binding = kLevelsBinding) readonly buffer Levels { int levels[]; };
layout(std430, binding = kRadianceBinding) buffer Radiance { vec4 radiance[]; };

void main() {
    uint item;
    if (!select_item(item)) return;
    int node = levels[item];
    vec3 sum = vec3(0.0);
    int end = nodes[node].subtree_end;
    for (int child = node + 1; child < end; child = nodes[child].subtree_end) {
        sum += nodes[child].area * radiance[child].rgb;
    }
    float area = nodes[node].area;
    if (area > 0.0) radiance[node].rgb = sum / area;
}
