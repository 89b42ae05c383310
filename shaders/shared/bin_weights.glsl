// SPDX-License-Identifier: GPL-3.0-or-later
// Antiradiance between the direction bins: native/display/bin_weights.h.
#include "shared/display_layout.glsl"

layout(location = kBinsLocation) uniform uint bin_count;
layout(location = kFaceSizeLocation) uniform uint face_size;

// 3 floats a bin, bins of each node in turn: A, W/(m2 sr).
layout(std430, binding = kAntiradianceBinding) readonly buffer Antiradiance {
    float antiradiance[];
};
layout(std430, binding = kBinTexelsBinding) readonly buffer BinTexels { BinTexel bin_texels[]; };

uint face_texel(float t) {
    int size = int(face_size);
    return uint(clamp(int((t + 1.0) * (0.5 * float(size))), 0, size - 1));
}

// native/links/cube_map.h
uint cube_texel(vec3 direction) {
    vec3 a = abs(direction);
    uint axis = a.x >= a.y ? (a.x >= a.z ? 0u : 2u) : (a.y >= a.z ? 1u : 2u);
    vec3 d = axis == 0u ? direction : axis == 1u ? direction.yzx : direction.zxy;
    float inverse = 1.0 / abs(d.x);
    uint face = 2u * axis + (d.x < 0.0 ? 1u : 0u);
    return (face * face_size + face_texel(d.z * inverse)) * face_size + face_texel(d.y * inverse);
}

vec3 bin_antiradiance(int row, uint bin) {
    uint first = 3u * (uint(row) * bin_count + bin);
    return vec3(antiradiance[first], antiradiance[first + 1u], antiradiance[first + 2u]);
}

// direction: any length but 0.
vec3 seen_antiradiance(int row, vec3 direction) {
    BinTexel t = bin_texels[cube_texel(direction)];
    vec3 sum = float(t.shares & 255u) * bin_antiradiance(row, t.bins01 & 65535u);
    sum += float(t.shares >> 8u & 255u) * bin_antiradiance(row, t.bins01 >> 16u);
    sum += float(t.shares >> 16u & 255u) * bin_antiradiance(row, t.bins23 & 65535u);
    sum += float(t.shares >> 24u) * bin_antiradiance(row, t.bins23 >> 16u);
    return sum * (1.0 / 255.0);
}
