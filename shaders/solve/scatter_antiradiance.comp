#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// J without its links: A_r(b) = Phi_r(b) / C(b), to the place of (bin, receiver). Each place has at
// most one segment; the others were cleared.
#include "shared/items.glsl"

layout(local_size_x = kWorkGroupSize) in;
layout(location = kNodeCountLocation) uniform uint node_count;
layout(location = kFirstBinLocation) uniform uint first_bin;
layout(std430, binding = kSegmentsBinding) readonly buffer Segments { Segment segments[]; };
layout(std430, binding = kFluxBinding) readonly buffer Flux { float flux[]; };
layout(std430, binding = kOwnAntiradianceBinding) writeonly buffer OwnAntiradiance { vec4 own[]; };

void main() {
    uint i;
    if (!select_item(i)) return;
    Segment segment = segments[i];
    vec3 phi = vec3(flux[3u * i], flux[3u * i + 1u], flux[3u * i + 2u]);
    uint bin = (segment.bin_and_count >> kSegmentCountBits) - first_bin;
    own[bin * node_count + uint(segment.receiver)] = vec4(phi * segment.inv_c, 0.0);
}
