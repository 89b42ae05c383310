// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/render_command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/stopwatch.h"
#include "pipeline/session.h"
#include "tools/obj_scene.h"
#include "tools/option_flags.h"
#include "tools/picture_file.h"
#include "tools/picture_flag.h"
#include "tools/terminal.h"

namespace antiradiance {

namespace {

struct CameraFlags {
    std::array<float, 3> eye{};     // units of the file
    std::array<float, 3> target{};  // units of the file
    float fov = 50;                 // degrees, across the longer side of the picture
    std::array<int, 2> resolution{800, 600};
    std::string up = "Y";
    CLI::Option* eye_flag = nullptr;
    CLI::Option* target_flag = nullptr;
};

struct RenderCommand {
    std::string scene;
    std::string picture;
    float scale = 1;  // metres a unit
    CameraFlags camera;
    Options options;
};

vec3 to_vec3(const std::array<float, 3>& v) {
    return {v[0], v[1], v[2]};
}

// The view frame at distance 1 as Blender's sensor fit "Auto" has it.
Camera make_camera(const CameraFlags& flags, float scale) {
    const vec3 eye = scale * to_vec3(flags.eye);
    const vec3 back = glm::normalize(eye - scale * to_vec3(flags.target));
    vec3 up = flags.up == "Z" ? vec3(0, 0, 1) : vec3(0, 1, 0);
    // Straight up or down, where `up` says nothing: the next axis is up in the picture.
    if (std::abs(glm::dot(up, back)) > 0.9999F) up = vec3(up.z, up.x, up.y);
    const vec3 right = glm::normalize(glm::cross(up, back));

    const auto [width, height] = flags.resolution;
    const float half = std::tan(glm::radians(flags.fov) / 2);
    const vec2 frame = half * vec2(width, height) / static_cast<float>(std::max(width, height));
    Camera camera;
    camera.to_world =
        mat4(vec4(right, 0), vec4(glm::cross(back, right), 0), vec4(back, 0), vec4(eye, 1));
    camera.left = -frame.x;
    camera.right = frame.x;
    camera.bottom = -frame.y;
    camera.top = frame.y;
    camera.clip_start = 0;
    camera.clip_end = RayScene::kInfinity;
    camera.width = camera.x1 = width;
    camera.height = camera.y1 = height;
    return camera;
}

void set_camera(const RenderCommand& command, Scene& scene) {
    const CameraFlags& flags = command.camera;
    if (flags.eye_flag->empty()) {
        scene.problems.emplace_back(
            "A picture needs a camera, and an OBJ file holds none: give --camera-eye and "
            "--camera-target, or leave out --output to solve without a picture");
    } else if (flags.eye == flags.target) {
        scene.problems.emplace_back(
            "The camera looks at the place where it stands: move --camera-target away from "
            "--camera-eye");
    } else {
        scene.camera = make_camera(flags, command.scale);
        scene.has_camera = true;
    }
}

RenderResult render(const RenderCommand& command) {
    Stopwatch watch;
    Scene scene;
    try {
        scene = read_obj(command.scene, command.scale);
    } catch (const SceneError& error) {
        scene.problems.emplace_back(error.what());
    }
    std::optional<PictureFile> file;
    if (!command.picture.empty()) {
        set_camera(command, scene);
        try {
            file.emplace(command.picture);
        } catch (const SceneError& error) {
            scene.problems.emplace_back(error.what());
        }
    }
    RenderResult result;
    {
        Terminal terminal;
        Session session;
        result = session.render(std::move(scene), command.options, false, watch.lap(),
                                terminal.progress());
    }
    if (file) file->write(result.picture);
    return result;
}

void run(const RenderCommand& command) {
    const RenderResult result = render(command);
    for (const std::string& warning : result.report.warnings)
        std::fprintf(stderr, "warning: %s\n", warning.c_str());
    if (command.options.report_path.empty()) std::puts(result.report.to_json().c_str());
}

void add_camera_flags(CLI::App& app, CameraFlags& camera) {
    const std::string group = "Camera";
    camera.eye_flag = app.add_option("--camera-eye", camera.eye,
                                     "Where the camera stands, in the file's units and axes")
                          ->type_name("X Y Z")
                          ->group(group);
    camera.target_flag = app.add_option("--camera-target", camera.target,
                                        "What it looks at, in the file's units and axes")
                             ->type_name("X Y Z")
                             ->group(group);
    camera.eye_flag->needs(camera.target_flag);
    camera.target_flag->needs(camera.eye_flag);
    app.add_option("--camera-fov", camera.fov,
                   "Field of view across the longer side of the picture, degrees")
        ->check(CLI::Range(1.0, 179.0))
        ->capture_default_str()
        ->group(group);
    app.add_option("--up", camera.up,
                   "Axis that is up in the picture; OBJ files do not say which one their maker "
                   "meant")
        ->transform(CLI::IsMember({"Y", "Z"}, CLI::ignore_case))
        ->capture_default_str()
        ->group(group);
    app.add_option("--resolution", camera.resolution, "Size of the picture in pixels")
        ->type_name("W H")
        ->check(CLI::Range(1, 65536))
        ->capture_default_str()
        ->group(group);
}

}  // namespace

void add_render_command(CLI::App& app) {
    CLI::App* sub = app.add_subcommand("render", "Solve the light of a scene and take a picture");
    auto command = std::make_shared<RenderCommand>();
    sub->add_option("SCENE.obj", command->scene,
                    "Wavefront OBJ with MTL: Kd (map_Kd) is the albedo, Ke (map_Ke) the emitted "
                    "radiance in W/(m2 sr)")
        ->required();
    add_picture_flag(*sub, command->picture, "without it the light is solved and reported only");
    sub->add_option("--scale", command->scale,
                    "Metres a unit of the file; OBJ files do not say what theirs is")
        ->check(CLI::Range(1e-6, 1e6))
        ->capture_default_str();
    add_camera_flags(*sub, command->camera);
    add_option_flags(*sub, command->options);
    sub->footer("Without --report-path the report goes to standard output.");
    sub->callback([command] { run(*command); });
}

}  // namespace antiradiance
