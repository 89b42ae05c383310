// SPDX-License-Identifier: GPL-3.0-or-later
// What arrives over the links of one segment: Phi_r(b) = pi sum ff (L_s, or -A_s(b) on - links).
#include "shared/items.glsl"
#include "shared/transport_layout.glsl"

layout(location = kNodeCountLocation) uniform uint node_count;
layout(location = kFirstBinLocation) uniform uint first_bin;
layout(location = kRelaxationLocation) uniform float relaxation;

layout(std430, binding = kLinksBinding) readonly buffer Links { Link links[]; };
layout(std430, binding = kSegmentsBinding) readonly buffer Segments { Segment segments[]; };
layout(std430, binding = kFluxBinding) buffer Flux { float flux[]; };
layout(std430, binding = kRadianceBinding) readonly buffer Radiance { vec4 radiance[]; };
#ifdef HAS_ANTIRADIANCE
layout(std430, binding = kAntiradianceBinding) readonly buffer Antiradiance { vec4 antiradiance[]; };
#endif
#ifdef HAS_CLUSTERS
#include "shared/moments.glsl"
layout(std430, binding = kAxesBinding) readonly buffer Axes { vec4 axes[]; };
layout(std430, binding = kSentMomentsBinding) readonly buffer SentMoments { vec4 sent_moments[]; };

// W/sr that a cluster sends along the bin; `number` as in Radiance.
vec3 cluster_intensity(float number, uint bin) {
    int first = (int(abs(number)) - 1) * kMomentCount;
    vec3 d = axes[bin].xyz;
    if (number < 0.0) {
        vec3 plain = sent_moments[first].rgb * d.x + sent_moments[first + 1].rgb * d.y +
                     sent_moments[first + 2].rgb * d.z;
        return max(plain, vec3(0.0));
    }
    vec4 moments[kMomentCount];
    for (int k = 0; k < kMomentCount; ++k) moments[k] = sent_moments[first + k];
    return max(clamped_cosine_sum(moments, d), vec3(0.0));
}
#endif

uint segment_bin(Segment segment) {
    return segment.bin_and_count >> kSegmentCountBits;
}

uint segment_size(Segment segment) {
    return segment.bin_and_count & ((1u << kSegmentCountBits) - 1u);
}

// In W/(m2 sr), or W/sr from a cluster.
vec3 carried(Link link, uint bin) {
#ifdef HAS_ANTIRADIANCE
    if (link.form_factor < 0.0) {
        return antiradiance[(bin - first_bin) * node_count + uint(link.source)].rgb;
    }
#endif
    vec4 sent = radiance[link.source];
#ifdef HAS_CLUSTERS
    if (sent.w != 0.0) return cluster_intensity(sent.w, bin);
#endif
    return sent.rgb;
}

// Links first_link + begin, + begin + step, ... of the segment.
vec3 gather_links(Segment segment, uint begin, uint step) {
    uint bin = segment_bin(segment);
    uint size = segment_size(segment);
    vec3 sum = vec3(0.0);
    for (uint i = begin; i < size; i += step) {
        Link link = links[segment.first_link + i];
        sum += link.form_factor * carried(link, bin);  // a - link's sign is its form factor's
    }
    return sum;
}

void store_flux(uint segment, vec3 sum) {
    const float kPi = 3.14159265358979;
    vec3 old = vec3(flux[3u * segment], flux[3u * segment + 1u], flux[3u * segment + 2u]);
    vec3 relaxed = mix(old, kPi * sum, relaxation);
    flux[3u * segment] = relaxed.r;
    flux[3u * segment + 1u] = relaxed.g;
    flux[3u * segment + 2u] = relaxed.b;
}
