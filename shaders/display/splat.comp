#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// Image-space splatting, as native/display/splatting.cpp has it: sums of irradiance times weight,
// and of weights, over the disks that cover a fragment.
#include "shared/work_items.glsl"

layout(local_size_x = kItemSize) in;
layout(std430, binding = kLightsBinding) readonly buffer Disks { Disk disks[]; };

shared Disk staged[kItemSize];
shared bool is_staged[kItemSize];

float weight(Receiver r, Disk s) {
    float cosine = dot(r.normal, s.normal);
    if (cosine <= kLeastDiskCosine) return 0.0;
    vec3 d = r.position - s.center;
    float share = dot(d, d) / (s.radius * s.radius);
    if (share >= 1.0 || abs(dot(d, s.normal)) > kMostDiskHeight * s.radius) return 0.0;
    return (1.0 - share) * (1.0 - share) * (cosine - kLeastDiskCosine) * s.exposed;
}

void stage(WorkItem item, uint place, uint lane) {
    int row = table_row(item, place);
    is_staged[lane] = row >= 0;
    if (is_staged[lane]) staged[lane] = disks[row];
}

void main() {
    WorkItem item = own_item();
    uint lane = gl_LocalInvocationID.x;
    uint own = own_receiver(item);
    Receiver receiver = receivers[own];
    vec4 sum = sums[own];
    uint end = last_place(item);
    for (uint begin = first_place; begin < end; begin += uint(kItemSize)) {
        uint count = min(end - begin, uint(kItemSize));
        barrier();
        if (lane < count) stage(item, begin + lane, lane);
        barrier();
        for (uint i = 0u; i < count; ++i) {
            if (is_staged[i]) sum += weight(receiver, staged[i]) * vec4(staged[i].irradiance, 1.0);
        }
    }
    if (has_receiver(item)) sums[own] = sum;
}
