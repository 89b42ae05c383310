#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// Final shooting, as native/display/shooting_antiradiance.cpp has it on the CPU: fragments lit by
// patch lights, radiance in front of each and antiradiance behind it.
#include "shared/bin_weights.glsl"
#include "shared/form_factor.glsl"
#include "shared/work_items.glsl"

layout(local_size_x = kItemSize) in;
layout(location = kEpsilonLocation) uniform float epsilon;
layout(location = kSubsetsLocation) uniform uint subsets;
layout(location = kSamplesLocation) uniform uint sample_count;
layout(std430, binding = kLightsBinding) readonly buffer Lights { Light lights[]; };
layout(std430, binding = kShapesBinding) readonly buffer Shapes { vec4 shapes[]; };

shared Light staged[kItemSize];
shared int staged_row[kItemSize];

vec3 shape_point(int row, uint i) {
    return shapes[uint(row) * (uint(kShapeCorners) + sample_count) + i].xyz;
}

// cos cos / d^2 between a point of the source and the receiver; d: from source to receiver.
float transfer(Receiver r, vec3 source_normal, vec3 d, float d2) {
    float cos_r = -dot(d, r.shading);
    if (cos_r <= 0.0 || dot(d, r.normal) >= 0.0) return 0.0;
    return abs(dot(d, source_normal)) * cos_r / (d2 * d2);
}

// cos / d^2 at a receiver of a light without extent.
float transfer_from_point(Receiver r, vec3 d, float d2) {
    float cos_r = -dot(d, r.shading);
    if (cos_r <= 0.0 || dot(d, r.normal) >= 0.0) return 0.0;
    return cos_r / (d2 * sqrt(d2));
}

bool in_one_plane(Receiver r, Light s, float height) {
    if (abs(height) < epsilon) return true;
    return abs(height) < kFlatHeight * s.radius && dot(r.normal, s.normal) > kFlatCosine;
}

float exact_form_factor(Receiver r, int row) {
    vec3 corners[kShapeCorners];
    for (int i = 0; i < kShapeCorners; ++i) corners[i] = shape_point(row, uint(i)) - r.position;
    return abs(point_form_factor(r.shading, corners));
}

// A light that is no point from here.
vec3 near_light(Receiver r, Light s, int row, bool in_front, bool is_close) {
    float exact = 0.0;
    if (is_close) {
        exact = kPi * exact_form_factor(r, row);
        if (in_front) return exact * s.radiance;
    }
    uint count = is_close ? sample_count : min(sample_count, uint(kMiddleSamples));
    float sum = 0.0;
    vec3 light = vec3(0.0);
    for (uint i = 0u; i < count; ++i) {
        vec3 d = r.position - shape_point(row, uint(kShapeCorners) + i);
        float w = transfer(r, s.normal, d, dot(d, d));
        if (w <= 0.0) continue;
        sum += w;
        light += w * (in_front ? s.radiance : -seen_antiradiance(row, d));
    }
    if (sum <= 0.0) return vec3(0.0);
    return light * (is_close ? exact / sum : s.area / float(count));
}

vec3 light_from(Receiver r, Light s, int row) {
    vec3 d = r.position - s.center;
    float d2 = dot(d, d);
    if (s.area == 0.0) {  // a cluster
        float w = transfer_from_point(r, d, d2);
        return w > 0.0 ? -w * seen_antiradiance(row, d) : vec3(0.0);
    }
    float height = dot(d, s.normal);
    float r2 = s.radius * s.radius;
    if (r.surface == s.surface || in_one_plane(r, s, height)) return vec3(0.0);
    if (d2 <= kFar * kFar * r2) {
        return near_light(r, s, row, height > 0.0, d2 < kClose * kClose * r2);
    }
    float w = transfer(r, s.normal, d, d2) * s.area;
    if (w <= 0.0) return vec3(0.0);
    return w * (height > 0.0 ? s.radiance : -seen_antiradiance(row, d));
}

void stage(WorkItem item, uint place, uint lane) {
    staged_row[lane] = table_row(item, place);
    if (staged_row[lane] >= 0) staged[lane] = lights[staged_row[lane]];
}

// Distance from `begin` to the first place of a subset.
uint first_of_subset(uint subset, uint begin) {
    return (subset + subsets - begin % subsets) % subsets;
}

void main() {
    WorkItem item = own_item();
    uint lane = gl_LocalInvocationID.x;
    uint own = own_receiver(item);
    Receiver receiver = receivers[own];
    vec3 sum = sums[own].rgb;
    uint end = last_place(item);
    for (uint begin = first_place; begin < end; begin += uint(kItemSize)) {
        uint count = min(end - begin, uint(kItemSize));
        barrier();
        if (lane < count) stage(item, begin + lane, lane);
        barrier();
        uint stop = has_receiver(item) ? count : 0u;
        for (uint i = first_of_subset(receiver.subset, begin); i < stop; i += subsets) {
            if (staged_row[i] >= 0) sum += light_from(receiver, staged[i], staged_row[i]);
        }
    }
    if (has_receiver(item)) sums[own] = vec4(sum, 0.0);
}
