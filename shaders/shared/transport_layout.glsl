// SPDX-License-Identifier: GPL-3.0-or-later
// What shaders/solve and native/solve agree on; compiled as GLSL and, by transport_layout_gl.h, as
// C++. Structs are std430: a vec3 starts at a multiple of 16 and a scalar may fill its fourth place.

const int kWorkGroupSize = 64;
const int kReduceGroupSize = 256;

const int kLinksBinding = 0;
const int kSegmentsBinding = 1;
const int kFluxBinding = 2;
const int kReceiversBinding = 3;
const int kNodesBinding = 4;
const int kLevelsBinding = 5;
const int kLeavesBinding = 6;
const int kRadianceBinding = 7;
const int kOwnAntiradianceBinding = 8;
const int kAntiradianceBinding = 9;
const int kIrradianceBinding = 10;
const int kStateBinding = 11;
const int kAxesBinding = 12;
const int kSurfacesBinding = 13;
const int kSentMomentsBinding = 14;
const int kReceivedMomentsBinding = 15;
const int kBindingCount = 16;

// Uniforms. Every shader runs over items [kFirst, kFirst + kCount) of its array.
const int kFirstLocation = 0;
const int kCountLocation = 1;
const int kNodeCountLocation = 2;   // stride between the bins of a batch
const int kFirstBinLocation = 3;    // of the batch
const int kRelaxationLocation = 4;  // share of the new value in the next state, 0..1
const int kAddLocation = 5;         // 1: add to what earlier chunks have left

struct Link {
    int source;         // node
    float form_factor;  // < 0: carries antiradiance
};

const uint kSegmentCountBits = 22u;

struct Segment {
    int receiver;        // node
    uint first_link;     // in the chunk's links
    uint bin_and_count;  // bin << kSegmentCountBits | links
    float inv_c;         // 1 / C(b), sr^-1
};

struct Node {
    int parent;       // -1: root
    int subtree_end;  // preorder: the subtree is [node, subtree_end)
    float area;       // m2, sum of the leaves'
    int cluster;      // index among the clusters; of a surface: -2 - its index; of other patches: -1
};

struct Leaf {
    vec3 source;  // W/(m2 sr)
    int node;
    vec3 reflectance;  // albedo / pi, sr^-1
    float row_scale;
};

struct SurfaceNode {
    vec3 normal;
    int node;
};

struct PassState {
    vec3 max_radiance;  // over the leaves, W/(m2 sr)
    float max_change;   // of a leaf's radiance in any colour, before relaxation
    vec3 max_gained;    // of what links have added to or taken from a leaf's source
    float unused;
};

// First and second directional moments: x, y, z, xx, yy, zz, xy, xz, yz.
const int kMomentCount = 9;
