// SPDX-License-Identifier: GPL-3.0-or-later
// The links that end at a patch, as Mückl & Dachsbacher, Fig. 2, draw them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "pipeline/options.h"
#include "pipeline/solved_scene.h"

namespace antiradiance {

enum class LinkKind : std::uint8_t {
    kNeeded,        // + link whose ends see each other, at least in part
    kOccluded,      // + link whose ends do not: IMPLICIT alone needs it
    kAntiradiance,  // - link: takes back what went through its source
};

// By LinkKind.
[[nodiscard]] std::span<const EnumItem> link_kinds();

struct PatchLink {
    NodeId source;
    NodeId receiver;  // the leaf, or an ancestor of it
    LinkKind kind;
    float form_factor;  // as in Link, - links below 0
    int bin;
};

struct PatchLinks {
    std::vector<PatchLink> links;  // by what they can bring to the leaf, the most first
    std::size_t total = 0;         // links there are, listed or not
};

// The leaf on the side of the surface that a ray meets first; kNone: nothing there, or a side that
// no light reaches. origin: m; direction: any length but 0.
[[nodiscard]] NodeId pick(const SolvedScene& solved, const vec3& origin, const vec3& direction);

// The links of the solution that end at a leaf or one of its ancestors: the `most` of them with the
// largest transfer to the leaf. Rays between some points of both ends tell what is needed.
[[nodiscard]] PatchLinks links_of(const SolvedScene& solved, NodeId leaf, std::size_t most);

}  // namespace antiradiance
