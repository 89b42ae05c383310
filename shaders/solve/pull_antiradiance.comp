#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// Area average of what the patches below an inner patch let pass by themselves; x: the inner patches
// of one level, y: the bins of the batch. Deeper levels have run before.
#include "shared/items.glsl"
#include "shared/nodes.glsl"

layout(local_size_x = kWorkGroupSize) in;
layout(location = kNodeCountLocation) uniform uint node_count;
layout(std430, binding = kLevelsBinding) readonly buffer Levels { int levels[]; };
layout(std430, binding = kOwnAntiradianceBinding) readonly buffer OwnAntiradiance { vec4 own[]; };
layout(std430, binding = kAntiradianceBinding) buffer Antiradiance { vec4 antiradiance[]; };

void main() {
    uint item;
    if (!select_item(item)) return;
    int node = levels[item];
    uint bin = gl_WorkGroupID.y * node_count;
    vec3 sum = vec3(0.0);
    int end = nodes[node].subtree_end;
    for (int child = node + 1; child < end; child = nodes[child].subtree_end) {
        vec3 value = own[bin + uint(child)].rgb;
        if (!is_leaf(child)) value += antiradiance[bin + uint(child)].rgb;
        sum += nodes[child].area * value;
    }
    float area = nodes[node].area;
    antiradiance[bin + uint(node)] = vec4(area > 0.0 ? sum / area : vec3(0.0), 0.0);
}
