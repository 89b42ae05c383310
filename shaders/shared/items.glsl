// SPDX-License-Identifier: GPL-3.0-or-later
// One invocation an item: items [first, first + count) of the shader's array.
#include "shared/transport_layout.glsl"

layout(location = kFirstLocation) uniform uint first_item;
layout(location = kCountLocation) uniform uint item_count;

// False: this invocation only fills up its work group.
bool select_item(out uint item) {
    item = first_item + gl_GlobalInvocationID.x;
    return gl_GlobalInvocationID.x < item_count;
}
