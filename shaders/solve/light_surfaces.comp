#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// Irradiance of a surface, with its own normal, by what reached the clusters above it.
#include "shared/items.glsl"
#include "shared/moments.glsl"
#include "shared/nodes.glsl"

layout(local_size_x = kWorkGroupSize) in;
layout(std430, binding = kSurfacesBinding) readonly buffer Surfaces { SurfaceNode surfaces[]; };
layout(std430, binding = kReceivedMomentsBinding) readonly buffer ReceivedMoments { vec4 received[]; };
layout(std430, binding = kIrradianceBinding) buffer Irradiance { vec4 irradiance[]; };

void main() {
    uint item;
    if (!select_item(item)) return;
    SurfaceNode surface = surfaces[item];
    vec4 moments[kMomentCount];
    for (int k = 0; k < kMomentCount; ++k) moments[k] = vec4(0.0);
    for (int n = nodes[surface.node].parent; n >= 0; n = nodes[n].parent) {
        int cluster = nodes[n].cluster;
        for (int k = 0; k < kMomentCount; ++k) moments[k] += received[cluster * kMomentCount + k];
    }
    irradiance[surface.node].rgb += max(clamped_cosine_sum(moments, surface.normal), vec3(0.0));
}
