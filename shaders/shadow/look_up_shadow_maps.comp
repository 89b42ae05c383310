#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// Share of a light's point that each lit point sees, 0..1: four texels compared, weighted
// bilinearly (Reeves, Salesin and Cook, "Rendering Antialiased Shadows with Depth Maps", 1987).
#include "shared/shadow_views.glsl"

layout(local_size_x = kShadowGroupSize) in;

layout(std430, binding = kLitPointsBinding) readonly buffer LitPoints {
    LitPoint points[];
};
layout(std430, binding = kVisibilityBinding) writeonly buffer Visibility {
    float visibility[];
};
layout(binding = kMapsUnit) uniform sampler2DArray maps;
layout(location = kPointCountLocation) uniform uint point_count;
layout(location = kColumnLocation) uniform uint column;
layout(location = kRowLengthLocation) uniform uint row_length;
layout(location = kBiasLocation) uniform float bias;

// Which face shows a point; -1: none.
int face_of(vec3 position) {
    if (light.face_count == 1) return 0;
    vec3 d = position - light.faces[0].origin;
    vec3 local = vec3(dot(light.faces[1].z, d), dot(light.faces[3].z, d), dot(light.faces[0].z, d));
    vec3 size = abs(local);
    if (size.z >= size.x && size.z >= size.y) {
        // Light of a surface does not go behind it.
        return local.z >= 0.0 ? 0 : light.face_count == 6 ? 5 : -1;
    }
    if (size.x >= size.y) return local.x >= 0.0 ? 1 : 2;
    return local.y >= 0.0 ? 3 : 4;
}

// A lit point along a view's axes.
struct Local {
    vec3 position;  // m
    vec3 normal;
};

// 0 where the texel holds a blocker: something before the point and above its plane. The plane
// stands for a bias that follows the slope: a surface never shadows itself, however flat the light
// falls on it, and nothing that stands on it loses its shadow.
float texel_visibility(ShadowView view, int image, Local point, ivec2 texel, int size) {
    texel = clamp(texel, ivec2(0), ivec2(size - 1));
    float depth = texelFetch(maps, ivec3(texel, image), 0).r;
    if (depth <= 0.0) return 1.0;
    vec3 start, per_z;
    ray_of(view, 2.0 * (vec2(texel) + 0.5) / float(size) - 1.0, start, per_z);
    vec3 blocker = start + along_z_of(view, depth) * per_z;
    float height = dot(point.normal, blocker - point.position);
    return height > bias && blocker.z < point.position.z - bias ? 0.0 : 1.0;
}

float visibility_in(int face, LitPoint lit) {
    ShadowView view = light.faces[face];
    int image = light.first_image + face;
    Local point = Local(to_local(view, lit.position - view.origin), to_local(view, lit.normal));
    // Light from behind the surface.
    if (!is_parallel(view) && dot(point.normal, point.position) >= 0.0) return 0.0;
    vec2 place = view.scale * point.position.xy / (is_parallel(view) ? 1.0 : point.position.z);
    if (point.position.z <= 0.0 || any(greaterThan(abs(place), vec2(1.0)))) return 1.0;
    int size = textureSize(maps, 0).x;
    vec2 at = 0.5 * (place + 1.0) * float(size) - 0.5;
    ivec2 texel = ivec2(floor(at));
    vec2 share = at - vec2(texel);
    float v00 = texel_visibility(view, image, point, texel, size);
    float v10 = texel_visibility(view, image, point, texel + ivec2(1, 0), size);
    float v01 = texel_visibility(view, image, point, texel + ivec2(0, 1), size);
    float v11 = texel_visibility(view, image, point, texel + ivec2(1, 1), size);
    return mix(mix(v00, v10, share.x), mix(v01, v11, share.x), share.y);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= point_count) return;
    LitPoint point = points[i];
    int face = face_of(point.position);
    visibility[i * row_length + column] = face < 0 ? 0.0 : visibility_in(face, point);
}
