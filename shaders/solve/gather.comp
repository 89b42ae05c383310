#version 450 core
// SPDX-License-Identifier: GPL-3.0-or-later
// One invocation a segment.
#include "shared/gather_links.glsl"

layout(local_size_x = kWorkGroupSize) in;

void main() {
    uint segment;
    if (!select_item(segment)) return;
    store_flux(segment, gather_links(segments[segment], 0u, 1u));
}
