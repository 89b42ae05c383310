// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/transport_layout.glsl"

layout(std430, binding = kNodesBinding) readonly buffer Nodes { Node nodes[]; };

bool is_patch(int node) {
    return node >= 0 && nodes[node].cluster < 0;
}

bool is_leaf(int node) {
    return nodes[node].subtree_end == node + 1;
}
