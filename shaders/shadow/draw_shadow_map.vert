#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// The scene's triangles as one view sees them.
#include "shared/shadow_views.glsl"

layout(std430, binding = kTrianglesBinding) readonly buffer Triangles {
    float corners[];  // m, 9 a triangle
};
layout(location = kFaceLocation) uniform uint face;

// Of the triangle, along the view's axes.
flat out vec3 plane_normal;  // any length
flat out vec3 plane_point;   // m

vec3 corner(uint i) {
    return vec3(corners[3u * i], corners[3u * i + 1u], corners[3u * i + 2u]);
}

void main() {
    ShadowView view = light.faces[face];
    uint first = uint(gl_VertexID) / 3u * 3u;
    vec3 a = corner(first);
    plane_point = to_local(view, a - view.origin);
    plane_normal = to_local(view, cross(corner(first + 1u) - a, corner(first + 2u) - a));
    vec3 local = to_local(view, corner(uint(gl_VertexID)) - view.origin);
    gl_Position = is_parallel(view)
        ? vec4(view.scale * local.xy, depth_of(view, local.z), 1.0)
        : vec4(view.scale * local.xy, view.near_end, local.z);
}
