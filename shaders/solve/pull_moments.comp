#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// What the clusters of one level send: M1 = sum A L n, M2 = sum A L n n^T over the surfaces below.
#include "shared/items.glsl"
#include "shared/moments.glsl"
#include "shared/nodes.glsl"

layout(local_size_x = kWorkGroupSize) in;
layout(std430, binding = kLevelsBinding) readonly buffer Levels { int levels[]; };
layout(std430, binding = kRadianceBinding) readonly buffer Radiance { vec4 radiance[]; };
layout(std430, binding = kSurfacesBinding) readonly buffer Surfaces { SurfaceNode surfaces[]; };
layout(std430, binding = kSentMomentsBinding) buffer SentMoments { vec4 sent[]; };

void main() {
    uint item;
    if (!select_item(item)) return;
    int node = levels[item];
    vec4 moments[kMomentCount];
    for (int k = 0; k < kMomentCount; ++k) moments[k] = vec4(0.0);
    int end = nodes[node].subtree_end;
    for (int child = node + 1; child < end; child = nodes[child].subtree_end) {
        int cluster = nodes[child].cluster;
        if (cluster >= 0) {
            for (int k = 0; k < kMomentCount; ++k) moments[k] += sent[cluster * kMomentCount + k];
        } else if (cluster < -1) {  // lamps link by themselves
            vec3 power = nodes[child].area * radiance[child].rgb;
            float basis[kMomentCount];
            direction_moments(surfaces[-2 - cluster].normal, basis);
            for (int k = 0; k < kMomentCount; ++k) moments[k].rgb += basis[k] * power;
        }
    }
    int own = nodes[node].cluster;
    for (int k = 0; k < kMomentCount; ++k) sent[own * kMomentCount + k] = moments[k];
}
