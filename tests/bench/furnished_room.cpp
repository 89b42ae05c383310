// SPDX-License-Identifier: GPL-3.0-or-later
#include "furnished_room.h"

#include <glm/gtc/matrix_transform.hpp>

#include "support/scene_builder.h"

namespace antiradiance::bench {

namespace {

using test::add_quad;

// The six faces of a box, seen from outside.
void add_box(Scene& scene, const std::string& name, const vec3& low, const vec3& high,
             int material) {
    const vec3 d = high - low;
    const vec3 x(d.x, 0, 0);
    const vec3 y(0, d.y, 0);
    const vec3 z(0, 0, d.z);
    add_quad(scene, name, low, y, x, material);
    add_quad(scene, name, low, x, z, material);
    add_quad(scene, name, low, z, y, material);
    add_quad(scene, name, high, -x, -y, material);
    add_quad(scene, name, high, -z, -x, material);
    add_quad(scene, name, high, -y, -z, material);
}

// A desk with its long side along x, and the monitor on it.
void add_desk(Scene& scene, const vec3& at, int wood, int plastic) {
    const vec3 size(1.6F, 0.8F, 0.74F);
    constexpr float kThick = 0.04F;
    add_box(scene, "Desk", at + vec3(0, 0, size.z - kThick), at + size, wood);
    for (const float x : {0.05F, size.x - 0.05F - kThick}) {
        for (const float y : {0.05F, size.y - 0.05F - kThick}) {
            const vec3 foot = at + vec3(x, y, 0);
            add_box(scene, "Leg", foot, foot + vec3(kThick, kThick, size.z - kThick), wood);
        }
    }
    const vec3 screen = at + vec3(0.5F, 0.5F, size.z + 0.1F);
    add_box(scene, "Monitor", screen, screen + vec3(0.6F, 0.03F, 0.35F), plastic);
    const vec3 stand = at + vec3(0.75F, 0.45F, size.z);
    add_box(scene, "Stand", stand, stand + vec3(0.1F, 0.04F, 0.1F), plastic);
}

void add_shelf(Scene& scene, const vec3& at, const vec3& size, int wood) {
    constexpr float kThick = 0.03F;
    for (const float x : {0.0F, size.x - kThick})
        add_box(scene, "Side", at + vec3(x, 0, 0), at + vec3(x + kThick, size.y, size.z), wood);
    constexpr int kBoards = 4;
    for (int i = 0; i < kBoards; ++i) {
        const float z = (size.z - kThick) * static_cast<float>(i) / (kBoards - 1);
        add_box(scene, "Board", at + vec3(kThick, 0, z),
                at + vec3(size.x - kThick, size.y, z + kThick), wood);
    }
}

void set_camera(Scene& scene) {
    Camera& c = scene.camera;
    // Level, from a corner towards the opposite one.
    c.to_world = glm::inverse(glm::lookAt(vec3(0.4F, 0.4F, 1.7F), vec3(5, 4, 0.9F), vec3(0, 0, 1)));
    c.left = -0.6F;
    c.right = 0.6F;
    c.bottom = -0.45F;
    c.top = 0.45F;
    c.width = c.x1 = 320;
    c.height = c.y1 = 240;
    scene.has_camera = true;
}

}  // namespace

Scene make_furnished_room() {
    Scene scene;
    const int wall = test::add_material(scene, vec3(0.75F));
    const int carpet = test::add_material(scene, {0.3F, 0.25F, 0.2F});
    const int wood = test::add_material(scene, {0.5F, 0.35F, 0.2F});
    const int plastic = test::add_material(scene, vec3(0.15F));
    const int lamp = test::add_material(scene, vec3(0), vec3(12));

    const vec3 x(7, 0, 0);
    const vec3 y(0, 5, 0);
    const vec3 z(0, 0, 2.8F);
    add_quad(scene, "Floor", vec3(0), x, y, carpet);
    add_quad(scene, "Ceiling", z, y, x, wall);
    add_quad(scene, "Wall", vec3(0), z, x, wall);
    add_quad(scene, "Wall", y, x, z, wall);
    add_quad(scene, "Wall", vec3(0), y, z, wall);
    add_quad(scene, "Wall", x, z, y, wall);
    for (const float at : {1.5F, 4.3F})
        add_quad(scene, "Panel", {at, 2, 2.79F}, {0, 1, 0}, {1.2F, 0, 0}, lamp);

    for (const vec3& at : {vec3(0.8F, 0.9F, 0), vec3(3.6F, 3.2F, 0)})
        add_desk(scene, at, wood, plastic);
    add_shelf(scene, {6.6F, 1, 0}, {0.35F, 1.2F, 2}, wood);
    set_camera(scene);
    return scene;
}

}  // namespace antiradiance::bench
