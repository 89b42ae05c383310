# SPDX-License-Identifier: GPL-3.0-or-later
"""Cameras as the core gets them, beside Cycles' pictures of where each pixel looks.

argument: folder for NAME.exr, Cycles' Position and Depth passes.
"""

import pathlib
import sys

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402

FOLDER = pathlib.Path(recorder.arguments()[0])

CASES = {  # name: (camera's settings, render's settings, scale of the camera object)
    "plain": ({}, {}, 1.0),
    "shifted": ({"shift_x": 0.2, "shift_y": -0.3}, {}, 1.0),
    "portrait": ({"shift_x": 0.1}, {"resolution_x": 30, "resolution_y": 50}, 1.0),
    "vertical_fit": ({"sensor_fit": "VERTICAL", "sensor_height": 20.0, "lens": 35.0}, {}, 1.0),
    "wide_pixels": ({"shift_x": 0.1, "shift_y": 0.1}, {"pixel_aspect_x": 2.0}, 1.0),
    "tall_pixels": ({"shift_y": 0.1}, {"pixel_aspect_y": 1.5}, 1.0),
    "percentage": ({}, {"resolution_percentage": 37}, 1.0),
    "scaled_object": ({}, {}, 2.5),
    "orthographic": ({"type": "ORTHO", "ortho_scale": 3.0}, {}, 1.0),
    "orthographic_shifted": ({"type": "ORTHO", "ortho_scale": 3.0, "shift_x": -0.3, "shift_y": 0.2},
                             {"pixel_aspect_x": 1.25}, 1.0),
    "border": ({"shift_x": 0.05}, {"use_border": True, "use_crop_to_border": True, "border_min_x": 0.21,
                        "border_max_x": 0.77, "border_min_y": 0.33, "border_max_y": 0.9}, 1.0),
}


def set_up(camera_settings, render_settings, scale):
    scene = recorder.empty_scene()
    recorder.cube("Surroundings", size=60.0)
    camera = scene.camera
    camera.location = (1.0, -2.0, 3.0)
    camera.rotation_euler = (1.1, 0.2, -0.7)
    camera.scale = (scale, scale, scale)
    for owner, settings in ((camera.data, camera_settings), (scene.render, render_settings)):
        for name, value in settings.items():
            setattr(owner, name, value)
    return scene


def render_positions(scene, path):
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 1
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 0.01  # the centre of each pixel
    scene.view_layers[0].use_pass_position = True
    scene.view_layers[0].use_pass_z = True
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def run(name, case):
    scene = set_up(*case)
    recorded, _ = recorder.sync()
    render_positions(scene, FOLDER / f"{name}.exr")
    return recorded.camera


def error_of(set_up_camera):
    scene = recorder.empty_scene()
    recorder.cube()
    set_up_camera(scene)
    try:
        recorder.sync()
    except recorder.addon("camera").CameraError as error:
        return str(error)
    return ""


def panoramic(scene):
    scene.camera.data.type = "PANO"


def lamp_as_camera(scene):
    scene.camera = recorder.link(bpy.data.lights.new("Lamp", "SPOT"), "Lamp")


result = {name: run(name, case) for name, case in CASES.items()}
result["panoramic"] = error_of(panoramic)
result["lamp_as_camera"] = error_of(lamp_as_camera)
recorder.finish(result)
