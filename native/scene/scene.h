// SPDX-License-Identifier: GPL-3.0-or-later
// The scene as plain arrays in world space: metres, radiance in W/(m2 sr), linear Rec.709.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/types.h"

namespace antiradiance {

struct Texture {
    std::string name;
    int width = 0;             // pixels
    int height = 0;            // pixels
    std::vector<vec4> pixels;  // width * height, linear Rec.709, row 0 is v = 0
    std::string missing_path;  // not empty: the file that could not be read

    // Bilinear, repeating; uv (0,0) is the lower left corner of pixel (0,0).
    [[nodiscard]] vec4 sample(const vec2& uv) const;
};

// A diffuse surface, both sides alike. A texture multiplies its constant.
struct Material {
    std::string name;
    vec3 albedo{0.8F};             // reflectance, 0..1
    vec3 emission{0};              // emitted radiance, W/(m2 sr)
    int albedo_texture = kNone;    // index into Scene::textures
    int emission_texture = kNone;  // index into Scene::textures
    [[nodiscard]] bool emits() const { return max_component(emission) > 0; }
};

enum class LampType { kPoint, kSpot, kSun, kArea };
enum class AreaShape { kRectangle, kEllipse };

// Blender's lamps. They light, but neither block light nor show to the camera (unless
// `visible_to_camera`).
struct Lamp {
    std::string name;
    LampType type = LampType::kPoint;
    mat4 to_world{1};      // shines along local -z, as in Blender; may hold a scale
    vec3 power{0};         // colour x W; sun: colour x W/m2 on a facing surface
    float radius = 0;      // m, of the sphere of a point or spot lamp
    float spot_angle = 0;  // rad, full cone
    float spot_blend = 0;  // 0..1, share of the cone that fades
    // Cycles of Blender 3.4 multiplies a spot's intensity by the cosine to its axis and ignores a
    // non-uniform scale (measured); newer ones do neither.
    bool spot_cosine = false;
    float sun_angle = 0;  // rad, full angle of the disk
    AreaShape shape = AreaShape::kRectangle;
    vec2 size{1};        // m, full extents along local x and y of an area lamp
    float spread = kPi;  // rad, full angle of an area lamp's cone; pi = diffuse
    bool visible_to_camera = false;
};

enum class CameraType { kPerspective, kOrthographic };

struct Camera {
    mat4 to_world{1};  // looks along local -z, y up; no scale
    CameraType type = CameraType::kPerspective;
    // The view frame on the plane at distance 1 (perspective) or in metres (orthographic).
    float left = -0.5F, right = 0.5F, bottom = -0.5F, top = 0.5F;
    float clip_start = 0.01F;            // m, along the view axis
    float clip_end = 1000;               // m, along the view axis
    int width = 0, height = 0;           // pixels of the full frame
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // pixels of it to render, [x0,x1) x [y0,y1), row 0 below

    bool operator==(const Camera&) const = default;
};

struct Object {
    std::string name;
    TriangleId first_triangle = 0;
    TriangleId triangle_count = 0;
};

// A surface that the artist puts where no light can go (Mückl & Dachsbacher, section 4.3): links
// between patches that cross it are cut. It is not rendered, and direct light goes through it.
struct Blocker {
    std::string name;
    std::vector<vec3> positions;   // m, world space
    std::vector<uvec3> triangles;  // into positions

    bool operator==(const Blocker&) const = default;
};

struct Scene {
    // #vertices
    std::vector<vec3> positions;  // m
    // #triangles
    std::vector<uvec3> triangles;  // into positions; counter-clockwise from its front
    std::vector<std::int32_t>
        triangle_polygon;  // polygon of the mesh it was cut from; unique in the scene
    std::vector<std::int32_t> triangle_material;  // into materials
    std::vector<std::int32_t> triangle_object;    // into objects
    std::vector<std::array<vec2, 3>> uv;          // texture coordinates of the corners
    std::vector<std::array<vec3, 3>> normals;     // unit shading normals of the corners

    std::vector<Object> objects;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<Lamp> lamps;
    std::vector<Blocker> blockers;
    Camera camera;
    bool has_camera = false;
    vec3 background{0};                 // radiance seen where no surface is
    std::vector<std::string> warnings;  // of whoever filled the scene
    std::vector<std::string> problems;  // found while it was filled; validate() throws them
    std::int32_t polygon_count = 0;     // ids in triangle_polygon are below this

    [[nodiscard]] std::array<vec3, 3> corners(TriangleId t) const {
        const uvec3 v = triangles[static_cast<std::size_t>(t)];
        return {positions[v.x], positions[v.y], positions[v.z]};
    }
    // (u, v): barycentric weights of corners 1 and 2.
    [[nodiscard]] vec3 albedo_at(TriangleId t, const vec2& barycentric) const;
    [[nodiscard]] vec3 emission_at(TriangleId t, const vec2& barycentric) const;
    [[nodiscard]] vec3 shading_normal_at(TriangleId t, const vec2& barycentric) const;
    [[nodiscard]] const std::string& object_name(TriangleId t) const {
        return objects[static_cast<std::size_t>(triangle_object[static_cast<std::size_t>(t)])].name;
    }
};

// m, > 0: the longest edge of the box around all triangles, and no less than a twentieth of its
// distance from the origin: far from it the spacing of floats, not the size, sets what can be told
// apart. 1 without triangles.
[[nodiscard]] float largest_extent(const Scene& scene);

// One mesh on its way into a scene. Arrays are borrowed until add_mesh returns.
struct MeshInput {
    std::string object_name;
    const vec3* positions = nullptr;  // #vertices, object space
    std::size_t position_count = 0;
    mat4 to_world{1};
    const uvec3* triangles = nullptr;  // #triangles
    std::size_t triangle_count = 0;
    const std::int32_t* triangle_polygon = nullptr;   // #triangles, or null: each its own
    const std::int32_t* triangle_material = nullptr;  // #triangles, slots, or null: slot 0
    std::vector<std::int32_t> slot_materials;         // slot -> Scene::materials
    const std::array<vec2, 3>* uv = nullptr;          // #triangles, or null
    const std::array<vec3, 3>* normals = nullptr;     // #triangles, object space, or null: flat
};

// Appends the mesh in world space. A mirroring matrix also flips the winding, so that fronts stay
// fronts. Throws nothing: what is wrong is left in Scene::problems or found by validate().
// A slot that holds no material gets a grey one (albedo 0.8, as Blender shows it); a slot number
// beyond the last means the last, as in Blender.
void add_mesh(Scene& scene, const MeshInput& mesh);

// Appends the mesh as a blocker; positions and triangles are all that is read. Throws nothing, as
// add_mesh().
void add_blocker(Scene& scene, const MeshInput& mesh);

}  // namespace antiradiance
