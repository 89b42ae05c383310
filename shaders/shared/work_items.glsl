// SPDX-License-Identifier: GPL-3.0-or-later
// One work group a work item: each invocation has a fragment, and all go through the item's list of
// nodes together. Sums are kept in the order of the list, dispatch after dispatch.
#include "shared/display_layout.glsl"

layout(location = kFirstItemLocation) uniform uint first_item;
layout(location = kFirstPlaceLocation) uniform uint first_place;
layout(location = kPlaceCountLocation) uniform uint place_count;
layout(location = kFirstNodeLocation) uniform uint first_node;
layout(location = kNodeCountLocation) uniform uint node_count;

layout(std430, binding = kReceiversBinding) readonly buffer Receivers { Receiver receivers[]; };
layout(std430, binding = kItemsBinding) readonly buffer Items { WorkItem items[]; };
layout(std430, binding = kListsBinding) readonly buffer Lists { uint lists[]; };
layout(std430, binding = kSumsBinding) buffer Sums { vec4 sums[]; };

WorkItem own_item() {
    return items[first_item + gl_WorkGroupID.x];
}

// Invocations beyond the item's fragments only help to read its nodes.
bool has_receiver(WorkItem item) {
    return gl_LocalInvocationID.x < item.receiver_count;
}

uint own_receiver(WorkItem item) {
    return item.first_receiver + min(gl_LocalInvocationID.x, item.receiver_count - 1u);
}

// The end of the dispatch's places in the item's list.
uint last_place(WorkItem item) {
    return min(item.place_count, first_place + place_count);
}

// Where the tables have the node at a place of the item's list; -1: it is the turn of other nodes.
int table_row(WorkItem item, uint place) {
    uint row = lists[item.first_place + place] - first_node;  // wraps round below the first
    return row < node_count ? int(row) : -1;
}
