// SPDX-License-Identifier: GPL-3.0-or-later
// What shaders/display and native/display agree on; compiled as GLSL and, by display_layout_gl.h,
// as C++. Structs are std430: a vec3 starts at a multiple of 16 and a scalar may fill its fourth
// place.

// Final shooting. Distances in radii of a light: beyond kFar its centre stands for it, within
// kClose its form factor is exact, between them a few of its points do.
const float kFar = 8.0F;
const float kClose = 4.0F;
const int kMiddleSamples = 4;
// Height above a light's plane, in radii of the light, that counts as in it for fragments that face
// the same way.
const float kFlatHeight = 0.03F;
const float kFlatCosine = 0.95F;

// Splatting.
const float kFootprint = 2.0F;         // radius of a disk, in radii of its leaf
const float kLeastDiskCosine = 0.8F;   // between the normals of disk and fragment
const float kMostDiskHeight = 0.25F;   // of a fragment above the disk, in radii of the disk

// Fragments of a work item: one work group, which takes as many of its nodes at a time.
const int kItemSize = 64;

const int kReceiversBinding = 0;
const int kItemsBinding = 1;
const int kListsBinding = 2;
const int kSumsBinding = 3;
const int kLightsBinding = 4;  // or disks
const int kShapesBinding = 5;
const int kAntiradianceBinding = 6;
const int kBinTexelsBinding = 7;

// Uniforms. A dispatch runs over items [kFirstItem, ...), places [kFirstPlace, + kPlaceCount) of
// their lists and, of what stands there, nodes [kFirstNode, + kNodeCount).
const int kFirstItemLocation = 0;
const int kFirstPlaceLocation = 1;
const int kPlaceCountLocation = 2;
const int kFirstNodeLocation = 3;
const int kNodeCountLocation = 4;
const int kEpsilonLocation = 5;   // m, heights above a plane that rounding explains
const int kSubsetsLocation = 6;   // that interleaving makes of a list
const int kSamplesLocation = 7;   // points on each light
const int kBinsLocation = 8;      // of antiradiance
const int kFaceSizeLocation = 9;  // texels along a face of the cube map of bin weights

struct Receiver {
    vec3 position;  // m
    int surface;    // -1: on a side that no link reaches
    vec3 normal;    // unit, of the geometry
    uint subset;    // of the nodes of its list: places subset, subset + kSubsets, ...
    vec3 shading;   // unit
    float unused;
};

struct WorkItem {
    uint first_receiver;  // in the batch
    uint receiver_count;  // 1..kItemSize
    uint first_place;     // in the batch's lists
    uint place_count;
};

struct Light {
    vec3 center;    // m
    float radius;   // m
    vec3 normal;    // unit
    float area;     // m2; 0: a cluster, whose antiradiance is an intensity, W/sr
    vec3 radiance;  // W/(m2 sr)
    int surface;
};

// A light's shape: its corners (a triangle's third one twice), then its points.
const int kShapeCorners = 4;

// A leaf as splatting draws it.
struct Disk {
    vec3 center;      // m
    float radius;     // m, of the disk
    vec3 normal;      // unit
    float exposed;    // share of the leaf outside of solids
    vec3 irradiance;  // W/m2
    float unused;
};

// Four bins' numbers in 16 bits each and the shares of 255 in 8 bits each.
struct BinTexel {
    uint bins01;
    uint bins23;
    uint shares;
};
