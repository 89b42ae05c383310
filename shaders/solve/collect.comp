#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// Sums the flux of a node's segments: the irradiance of a patch, the directional moments of what
// reaches a cluster.
#include "shared/items.glsl"
#include "shared/moments.glsl"
#include "shared/nodes.glsl"

layout(local_size_x = kWorkGroupSize) in;
layout(location = kNodeCountLocation) uniform uint node_count;
layout(location = kAddLocation) uniform uint add;
layout(std430, binding = kFluxBinding) readonly buffer Flux { float flux[]; };
layout(std430, binding = kReceiversBinding) readonly buffer Receivers { uint receivers[]; };
layout(std430, binding = kIrradianceBinding) buffer Irradiance { vec4 irradiance[]; };
#ifdef HAS_CLUSTERS
layout(std430, binding = kSegmentsBinding) readonly buffer Segments { Segment segments[]; };
layout(std430, binding = kAxesBinding) readonly buffer Axes { vec4 axes[]; };
layout(std430, binding = kReceivedMomentsBinding) buffer ReceivedMoments { vec4 received[]; };
#endif

vec3 segment_flux(uint segment) {
    return vec3(flux[3u * segment], flux[3u * segment + 1u], flux[3u * segment + 2u]);
}

#ifdef HAS_CLUSTERS
void collect_moments(int cluster, uint begin, uint end) {
    vec4 moments[kMomentCount];
    for (int k = 0; k < kMomentCount; ++k) {
        moments[k] = add == 0u ? vec4(0.0) : received[cluster * kMomentCount + k];
    }
    for (uint i = begin; i < end; ++i) {
        uint segment = receivers[node_count + 1u + i];
        uint bin = segments[segment].bin_and_count >> kSegmentCountBits;
        float basis[kMomentCount];
        direction_moments(-axes[bin].xyz, basis);
        vec3 phi = segment_flux(segment);
        for (int k = 0; k < kMomentCount; ++k) moments[k].rgb += basis[k] * phi;
    }
    for (int k = 0; k < kMomentCount; ++k) received[cluster * kMomentCount + k] = moments[k];
}
#endif

void main() {
    uint node;
    if (!select_item(node)) return;
    uint begin = receivers[node];
    uint end = receivers[node + 1u];
    vec3 sum = add == 0u ? vec3(0.0) : irradiance[node].rgb;
#ifdef HAS_CLUSTERS
    int cluster = nodes[node].cluster;
    if (cluster >= 0) {
        collect_moments(cluster, begin, end);
        return;
    }
#endif
    for (uint i = begin; i < end; ++i) sum += segment_flux(receivers[node_count + 1u + i]);
    irradiance[node] = vec4(sum, 0.0);
}
