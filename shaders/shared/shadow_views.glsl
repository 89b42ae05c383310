// SPDX-License-Identifier: GPL-3.0-or-later
// Views of shadow maps: their rays, and depth that keeps its precision (reversed, DepthImages).
#include "shared/shadow_layout.glsl"

// Uniform, so that software renderers read it once for many invocations.
layout(std140, binding = kLightBinding) uniform Light {
    ShadowLight light;
};

bool is_parallel(ShadowView view) {
    return view.far_end > 0.0;
}

// A vector along the view's axes.
vec3 to_local(ShadowView view, vec3 d) {
    return vec3(dot(view.x, d), dot(view.y, d), dot(view.z, d));
}

// The ray through a place of the image, along the view's axes: its point at distance c along z is
// start + c * per_z.
void ray_of(ShadowView view, vec2 place, out vec3 start, out vec3 per_z) {
    vec3 aside = vec3(place / view.scale, 0.0);
    vec3 z = vec3(0.0, 0.0, 1.0);
    start = is_parallel(view) ? aside : vec3(0.0);
    per_z = is_parallel(view) ? z : z + aside;
}

float depth_of(ShadowView view, float along_z) {
    return is_parallel(view) ? 1.0 - along_z / view.far_end : view.near_end / along_z;
}

float along_z_of(ShadowView view, float depth) {
    return is_parallel(view) ? view.far_end * (1.0 - depth) : view.near_end / depth;
}
