#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// The depth where the ray of a texel's centre meets the triangle's plane. The rasteriser's own, from
// corners that may lie far off or were cut at the near end, is wrong by millimetres.
#include "shared/shadow_views.glsl"

layout(location = kFaceLocation) uniform uint face;
layout(location = kImageSizeLocation) uniform float image_size;  // texels

flat in vec3 plane_normal;
flat in vec3 plane_point;

void main() {
    ShadowView view = light.faces[face];
    vec3 start, per_z;
    ray_of(view, 2.0 * gl_FragCoord.xy / image_size - 1.0, start, per_z);
    float slope = dot(plane_normal, per_z);
    // Seen edge-on, a plane has no one distance.
    bool is_steep = abs(slope) < 1e-4 * length(plane_normal) * length(per_z);
    float exact = depth_of(view, dot(plane_normal, plane_point - start) / slope);
    gl_FragDepth = is_steep ? gl_FragCoord.z : clamp(exact, 0.0, 1.0);
}
