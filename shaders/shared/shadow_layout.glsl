// SPDX-License-Identifier: GPL-3.0-or-later
// What shaders/shadow and native/solve agree on; compiled as GLSL and, by shadow_layout_gl.h, as
// C++. Structs have one layout in std140 and std430: a vec3 starts at a multiple of 16 and a scalar
// may fill its fourth place.

const int kShadowGroupSize = 64;

// Storage buffers
const int kTrianglesBinding = 0;
const int kLitPointsBinding = 1;
const int kVisibilityBinding = 2;
// Uniform buffer
const int kLightBinding = 0;
// Texture
const int kMapsUnit = 0;
// Uniforms
const int kFaceLocation = 0;        // that is drawn
const int kImageSizeLocation = 1;   // texels along a side
const int kPointCountLocation = 2;  // of this call
const int kColumnLocation = 3;      // of this light in a row of the visibilities
const int kRowLengthLocation = 4;   // visibilities of a point
const int kBiasLocation = 5;        // m

// One image: a point at local coordinates (a, b, c) along x, y, z from the origin is seen at
// scale * (a, b) / c, or at scale * (a, b) in a parallel view, both in -1..1.
struct ShadowView {
    vec3 x;  // unit, as y and z
    float scale;
    vec3 y;
    float near_end;  // m along z; of a perspective view
    vec3 z;
    float far_end;  // m along z; of a parallel view, whose near end is 0; 0: perspective
    vec3 origin;    // m
    float unused;
};

const int kMostFaces = 6;

// The images of one point of a light: one, or the faces +z +x -x +y -y and perhaps -z of a cube.
// As long as the alignment of uniform buffers asks for.
struct ShadowLight {
    ShadowView faces[kMostFaces];
    int face_count;
    int first_image;
    int unused_1, unused_2;
    vec4 unused[7];
};

struct LitPoint {
    vec3 position;  // m
    float unused_1;
    vec3 normal;  // unit, of the geometry, on the side that is lit
    float unused_2;
};
