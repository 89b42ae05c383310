// SPDX-License-Identifier: GPL-3.0-or-later
// G-buffer, passes and pictures of scenes whose pixels are known.
#include "display/display.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "base/parallel.h"
#include "display/gbuffer.h"
#include "display/visible_lamps.h"
#include "support/scene_builder.h"
#include "support/scenes.h"
#include "support/tree_builder.h"

namespace antiradiance {
namespace {

constexpr float kNoDepth = 1e10F;

// Looks down the z axis from z = 5 at [-1, 1] x [-1, 1] of the plane z = 4.
void look_down(Scene& scene, int width, int height, CameraType type = CameraType::kPerspective) {
    scene.has_camera = true;
    Camera& c = scene.camera;
    c.type = type;
    c.to_world = glm::translate(mat4(1), vec3(0, 0, 5));
    c.left = c.bottom = -1;
    c.right = c.top = 1;
    c.width = c.x1 = width;
    c.height = c.y1 = height;
}

struct Stage {
    Scene scene;
    RayScene rays;
    BlockingPlanes planes;  // none
    PatchTree tree;
    Progress progress;
    DirectLight direct;
    std::vector<vec3> irradiance;  // #nodes

    explicit Stage(const Scene& s, float max_edge = 0.5F)
        : scene(s),
          rays(scene),
          tree(test::front_tree(scene, max_edge)),
          direct(scene, rays, DirectLightMode::kExplicit, progress),
          irradiance(tree.size(), vec3(0)) {}

    GBuffer gbuffer(int samples_per_axis = 4, bool transparent = false) {
        return make_gbuffer({scene, scene.camera, rays, tree, &direct, irradiance, irradiance, true,
                             transparent, samples_per_axis, 16},
                            progress, {0, 1});
    }
    Picture picture(bool transparent = false) {
        const std::unique_ptr<DisplayBackend> backend = make_cpu_display();
        return make_picture({scene, scene.camera, rays, planes, tree, LinkSet{}, nullptr, direct,
                             irradiance, irradiance, irradiance, transparent, 4},
                            {.mode = DisplayMode::kPatches}, *backend, progress);
    }
};

TEST(GBuffer, CoverageOfEveryPixelAddsUpToOne) {
    Scene scene = test::office();
    scene.background = vec3(0.25F);
    scene.has_camera = true;
    Camera& c = scene.camera;
    // From above the open side of the room: edges, small patches and background.
    c.to_world = glm::inverse(glm::lookAt(vec3(9, 2, 5), vec3(2, 2, 1), vec3(0, 0, 1)));
    c.width = c.x1 = 48;
    c.height = c.y1 = 32;
    Stage stage(scene);
    for (const bool transparent : {false, true}) {
        const GBuffer buffer = stage.gbuffer(4, transparent);
        std::vector<float> covered(48UL * 32UL, 0);
        for (std::size_t i = 0; i < buffer.fragments.size(); ++i) {
            const Fragment& f = buffer.fragments[i];
            covered[f.pixel] += f.coverage;
            EXPECT_GT(f.coverage, 0);
            if (i > 0) {
                EXPECT_LE(buffer.fragments[i - 1].pixel, f.pixel) << "by pixel";
            }
            EXPECT_NEAR(glm::length(f.normal), 1, 1e-4F);
        }
        int partly = 0;
        for (std::size_t p = 0; p < covered.size(); ++p) {
            const float open = 1 - covered[p];
            ASSERT_NEAR(buffer.background[p].w, transparent ? 0 : open, 1e-5F);
            ASSERT_NEAR(buffer.background[p].x, transparent ? 0 : 0.25F * open, 1e-5F);
            ASSERT_LE(covered[p], 1 + 1e-5F);
            if (covered[p] > 0.01F && covered[p] < 0.99F) ++partly;
        }
        EXPECT_GT(partly, 20) << "edges are smooth";
    }
}

TEST(GBuffer, FragmentsKnowTheirLeaf) {
    Scene scene;
    const int m = test::add_material(scene, vec3(0.2F, 0.4F, 0.6F), vec3(3));
    test::add_quad(scene, "Quad", vec3(-2, -2, 0), vec3(4, 0, 0), vec3(0, 4, 0), m);
    look_down(scene, 16, 16);
    Stage stage(scene, 1);
    for (const Fragment& f : stage.gbuffer().fragments) {
        ASSERT_NE(f.leaf, kNone);
        EXPECT_EQ(stage.tree.lookup(0, false, f.position), f.leaf);
        EXPECT_LT(glm::distance(f.albedo, vec3(0.2F, 0.4F, 0.6F)), 1e-5F);
        EXPECT_GE(f.light.x, 3 - 1e-5F);  // and its own light, reflected nowhere
        EXPECT_EQ(f.normal, vec3(0, 0, 1));
        EXPECT_NEAR(f.position.z, 0, 1e-5F);
    }
}

TEST(Passes, DepthIsMeasuredAlongTheAxis) {
    for (const CameraType type : {CameraType::kPerspective, CameraType::kOrthographic}) {
        Scene scene;
        const int m = test::add_material(scene, vec3(0.5F));
        test::add_quad(scene, "Floor", vec3(-20, -20, 0), vec3(40, 0, 0), vec3(0, 40, 0), m);
        look_down(scene, 9, 9, type);
        // A plane that faces the camera is as deep everywhere, as in Blender's Z pass.
        for (const float depth : Stage(scene).picture().depth)
            EXPECT_NEAR(depth, 5, 1e-4F);
        scene.camera.clip_end = 4;
        for (const float depth : Stage(scene).picture().depth)
            EXPECT_EQ(depth, kNoDepth);
        scene.camera.clip_end = 100;
        scene.camera.clip_start = 5.5F;
        for (const float depth : Stage(scene).picture().depth)
            EXPECT_EQ(depth, kNoDepth);
    }
}

TEST(Passes, NormalsFaceTheViewerAndAreMeanOverAPixel) {
    Scene scene;
    const int m = test::add_material(scene, vec3(0.5F));
    // A roof with its ridge along y; its left half shows its back.
    test::add_polygon(scene, "Left", {{-9, -9, 0}, {-9, 9, 0}, {0, 9, 1}, {0, -9, 1}}, m);
    test::add_polygon(scene, "Right", {{0, -9, 1}, {9, -9, 0}, {9, 9, 0}, {0, 9, 1}}, m);
    look_down(scene, 3, 1);
    scene.camera.bottom = -0.33F;
    scene.camera.top = 0.33F;
    const Picture picture = Stage(scene).picture();
    const vec3 left = glm::normalize(vec3(-1, 0, 9));
    EXPECT_LT(glm::distance(picture.normal[0], left), 1e-4F);
    EXPECT_LT(glm::distance(picture.normal[1], vec3(0, 0, 1)), 1e-2F);
    EXPECT_LT(glm::distance(picture.normal[2], left * vec3(-1, 1, 1)), 1e-4F);
}

TEST(Passes, NothingIsSeenWhereNothingIs) {
    Scene scene;
    test::add_quad(scene, "Far off", vec3(100, 100, 0), vec3(1, 0, 0), vec3(0, 1, 0),
                   test::add_material(scene, vec3(0.5F)));
    scene.background = {1, 2, 3};
    look_down(scene, 4, 4);
    for (const bool transparent : {false, true}) {
        const Picture picture = Stage(scene).picture(transparent);
        for (std::size_t i = 0; i < 16; ++i) {
            EXPECT_EQ(picture.combined[i], transparent ? vec4(0) : vec4(1, 2, 3, 1));
            EXPECT_EQ(picture.depth[i], kNoDepth);
            EXPECT_EQ(picture.normal[i], vec3(0));
        }
    }
}

TEST(Picture, PatchesShowAlbedoTimesTheirIrradiance) {
    Scene scene;
    const int m = test::add_material(scene, vec3(0.2F, 0.4F, 0.8F), vec3(0.1F, 0, 0));
    test::add_quad(scene, "Floor", vec3(-10, -10, 0), vec3(20, 0, 0), vec3(0, 20, 0), m);
    look_down(scene, 8, 8);
    Stage stage(scene, 100);
    for (const NodeId leaf : stage.tree.leaves)
        stage.irradiance[static_cast<std::size_t>(leaf)] = vec3(kPi, 2 * kPi, 0);
    for (const vec4& pixel : stage.picture().combined)
        EXPECT_LT(glm::distance(pixel, vec4(0.2F + 0.1F, 0.8F, 0, 1)), 1e-5F);
}

TEST(Picture, OfTheBorderIsThePartOfTheWhole) {
    Scene scene;
    test::add_quad(scene, "Floor", vec3(-8, -8, 0), vec3(16, 0, 0), vec3(0, 16, 0),
                   test::add_material(scene, vec3(1)));
    look_down(scene, 12, 10);
    Stage stage(scene, 0.25F);
    for (const NodeId leaf : stage.tree.leaves) {
        const auto n = static_cast<std::size_t>(leaf);
        stage.irradiance[n] = kPi * (stage.tree.center[n] + 10.0F);  // its place as its colour
    }
    const Picture whole = stage.picture();
    Camera& c = stage.scene.camera;
    c.x0 = 3;
    c.x1 = 7;
    c.y0 = 2;
    c.y1 = 9;
    const Picture part = stage.picture();
    ASSERT_EQ(part.width, 4);
    ASSERT_EQ(part.height, 7);
    for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 4; ++x) {
            const vec4 a = part.combined[static_cast<std::size_t>(4 * y + x)];
            const vec4 b = whole.combined[static_cast<std::size_t>(12 * (y + 2) + x + 3)];
            // Other samples of the same pixel; pixels are .83 m and 1 m apart, patches .25 m.
            EXPECT_LT(glm::distance(a, b), 0.25F) << x << ", " << y;
        }
    }
}

// A lamp at the origin that the camera at z = 5 looks at.
Lamp visible(LampType type) {
    Lamp lamp;
    lamp.name = "lamp";
    lamp.type = type;
    lamp.power = vec3(4, 8, 12);
    lamp.radius = 0.5F;
    lamp.spot_angle = kPi;
    lamp.to_world = glm::rotate(mat4(1), kPi, vec3(1, 0, 0));  // shines up, at the camera
    lamp.visible_to_camera = true;
    return lamp;
}

CameraRay down(float x, float y) {
    CameraRay ray;
    ray.origin = {x, y, 5};
    ray.direction = {0, 0, -1};
    ray.far = 100;
    return ray;
}

float red(const Lamp& lamp, const CameraRay& ray, float far = RayScene::kInfinity) {
    return VisibleLamps(std::span(&lamp, 1)).radiance(ray, far).x;
}

TEST(VisibleLamps, OnlyThoseTheArtistAsksFor) {
    Lamp lamp = visible(LampType::kPoint);
    lamp.visible_to_camera = false;
    EXPECT_FALSE(VisibleLamps(std::span(&lamp, 1)).any());
    EXPECT_EQ(red(lamp, down(0, 0)), 0);
}

TEST(VisibleLamps, AreAsBrightAsTheirPowerOverTheirSize) {
    // A sphere of radius .5 that sends 4 W / (4 pi) per sr over a disk of pi / 4 m2.
    const Lamp point = visible(LampType::kPoint);
    EXPECT_NEAR(red(point, down(0.3F, 0.2F)), 4 / (4 * kPi) / (kPi / 4), 1e-5F);
    EXPECT_EQ(red(point, down(0.45F, 0.45F)), 0);
    // An area lamp of 1 m2 shows power / 4, and its back shows nothing.
    Lamp area = visible(LampType::kArea);
    EXPECT_NEAR(red(area, down(0.45F, 0.45F)), 1, 1e-5F);
    EXPECT_EQ(red(area, down(0.55F, 0)), 0);
    area.shape = AreaShape::kEllipse;
    EXPECT_EQ(red(area, down(0.45F, 0.45F)), 0);
    EXPECT_NEAR(red(area, down(0.2F, 0.2F)), 4 / kPi, 1e-4F);
    area.to_world = mat4(1);
    EXPECT_EQ(red(area, down(0, 0)), 0);
    // 4 W/m2 from a disk of the sky 0.2 rad wide.
    Lamp sun = visible(LampType::kSun);
    sun.sun_angle = 0.2F;
    EXPECT_NEAR(red(sun, down(3, 4)), 4 / (kPi * std::pow(std::sin(0.1F), 2.0F)), 0.1F);
    CameraRay aside = down(0, 0);
    aside.direction = glm::normalize(vec3(std::tan(0.11F), 0, -1));
    EXPECT_EQ(red(sun, aside), 0);
}

TEST(VisibleLamps, HideBehindSurfaces) {
    const Lamp point = visible(LampType::kPoint);
    EXPECT_EQ(red(point, down(0, 0), 4.4F), 0);
    EXPECT_GT(red(point, down(0, 0), 4.6F), 0);
    Lamp sun = visible(LampType::kSun);
    sun.sun_angle = 0.2F;
    EXPECT_EQ(red(sun, down(0, 0), 1e6F), 0);
}

TEST(VisibleLamps, ShowInThePicture) {
    Scene scene;
    test::add_quad(scene, "Floor", vec3(-9, -9, -1), vec3(18, 0, 0), vec3(0, 18, 0),
                   test::add_material(scene, vec3(0.5F)));
    scene.lamps.push_back(visible(LampType::kArea));
    look_down(scene, 21, 21);
    const Picture picture = Stage(scene).picture();
    // The lamp shines up: it shows as power / 4 in the middle and lights nothing of the floor.
    EXPECT_NEAR(picture.combined[21 * 10 + 10].x, 1, 1e-4F);
    EXPECT_NEAR(picture.combined[21 * 10 + 10].y, 2, 1e-4F);
    EXPECT_EQ(picture.combined[0].x, 0);
}

}  // namespace
}  // namespace antiradiance
