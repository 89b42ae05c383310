// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/scenes.h"

#include <glm/gtc/matrix_transform.hpp>

#include "support/scene_builder.h"

namespace antiradiance::test {

namespace {

constexpr float kPanelRadiance = 10;  // W/(m2 sr)

// A room with its corner at the origin; material 0 is its white, material 1 shines.
Scene room(const vec3& size) {
    Scene scene;
    const int white = add_material(scene, vec3(0.7F));
    add_material(scene, vec3(0), vec3(kPanelRadiance));
    add_box(scene, "Room", vec3(0), size, white, Facing::kInward);
    return scene;
}

void add_panel(Scene& scene, const vec3& corner, const vec2& size) {  // its front looks down
    add_quad(scene, "Panel", corner, vec3(0, size.y, 0), vec3(size.x, 0, 0), 1);
}

}  // namespace

void add_office_camera(Scene& scene, int width, int height) {
    scene.has_camera = true;
    Camera& camera = scene.camera;
    camera.to_world =
        glm::inverse(glm::lookAt(vec3(5.8F, 2, 1.5F), vec3(0, 2, 0.8F), vec3(0, 0, 1)));
    camera.width = camera.x1 = width;
    camera.height = camera.y1 = height;
}

Scene office() {
    Scene scene = room({6, 4, 2.7F});
    const int wood = add_material(scene, vec3(0.5F));
    for (const float x : {0.8F, 3.4F}) {
        add_box(scene, "Desk top", {x, 1, 0.7F}, {x + 1.6F, 1.8F, 0.75F}, wood);
        add_box(scene, "Desk block", {x + 0.1F, 1.1F, 0}, {x + 0.6F, 1.7F, 0.7F}, wood);
        add_box(scene, "Desk leg", {x + 1.4F, 1.1F, 0}, {x + 1.5F, 1.7F, 0.7F}, wood);
    }
    add_box(scene, "Cupboard", {2, 3.5F, 0}, {3.5F, 4.2F, 1.9F}, wood);
    add_panel(scene, {2, 1.2F, 2.6F}, {2, 1});
    return scene;
}

Scene corridor() {
    Scene scene = room({8, 5, 2.7F});
    const auto wall = [&](const vec2& low, const vec2& high) {
        add_box(scene, "Partition", vec3(low, 0), vec3(high, 2.7F), 0);
    };
    for (const float y : {1.9F, 3.0F}) {  // both sides of the corridor, two doors in each
        wall({0, y}, {1.5F, y + 0.1F});
        wall({2.4F, y}, {5.5F, y + 0.1F});
        wall({6.4F, y}, {8, y + 0.1F});
    }
    wall({3.95F, 0}, {4.05F, 1.9F});
    wall({3.95F, 3.1F}, {4.05F, 5});
    add_panel(scene, {1.5F, 0.6F, 2.6F}, {1, 0.6F});
    add_panel(scene, {5.5F, 3.8F, 2.6F}, {1, 0.6F});
    return scene;
}

Scene floating_boxes(int count) {
    const auto extent = static_cast<float>(count);
    Scene scene = room(vec3(extent));
    const int grey = add_material(scene, vec3(0.5F));
    for (int i = 0; i < count * count * count; ++i) {
        const vec3 place(static_cast<float>(i % count), static_cast<float>(i / count % count),
                         static_cast<float>(i / count / count));
        const float size = 0.2F + 0.05F * static_cast<float>(i % 7);
        add_box(scene, "Box", place + 0.25F, place + 0.25F + vec3(size, 0.35F, size), grey);
    }
    add_panel(scene, vec3(0.3F * extent, 0.3F * extent, 0.97F * extent), vec2(0.4F * extent));
    return scene;
}

}  // namespace antiradiance::test
