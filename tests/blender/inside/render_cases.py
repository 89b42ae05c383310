# SPDX-License-Identifier: GPL-3.0-or-later
"""Small scenes with known pictures, each rendered to NAME.exr (all passes, multilayer).

argument: the folder. Result: {NAME: {"report": the JSON report, ...what the case returned}}.
"""

import json
import math
import pathlib
import sys

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402
from recorder import cube, link, material, quad  # noqa: E402

FOLDER = pathlib.Path(recorder.arguments()[0])
CASES = {}
TOWARDS_CAMERA = (math.pi / 2, 0.0, 0.0)  # turns quad() to face the camera of empty_scene()
EMISSION = (0.25, 0.5, 1.0)


def case(build):
    CASES[build.__name__] = build
    return build


def shown(thing, **colours):
    thing.data.materials.append(material(thing.name, **colours))
    return thing


def sun(strength, direction_euler=(0.0, 0.0, 0.0)):
    light = bpy.data.lights.new("Sun", "SUN")
    light.energy = strength
    light.angle = 0.0
    return link(light, "Sun", rotation_euler=direction_euler)


def lamp(kind, energy, **settings):
    light = bpy.data.lights.new(kind.title(), kind)
    light.energy = energy
    for name, value in settings.items():
        setattr(light, name, value)
    return light


def room():
    """Four walls, a block and a lamp; coarse, as OpenGL in software takes 20 s at the defaults."""
    settings = bpy.context.scene.antiradiance
    settings.link_threshold, settings.max_patch_size = 0.1, 0.5
    quad("Floor", scale=(3, 3, 1), location=(0, 0, -2))
    quad("Ceiling", scale=(3, 3, 1), location=(0, 0, 2), rotation_euler=(math.pi, 0, 0))
    shown(quad("Back", scale=(3, 2, 1), location=(0, 3, 0), rotation_euler=TOWARDS_CAMERA),
          albedo=(0.7, 0.3, 0.2))
    shown(quad("Left", scale=(2, 3, 1), location=(-3, 0, 0), rotation_euler=(0, math.pi / 2, 0)),
          albedo=(0.2, 0.6, 0.3))
    shown(cube("Block", size=1.5, location=(0.7, 0.5, -1.1)), albedo=(0.5, 0.5, 0.6))
    link(lamp("POINT", 400.0, shadow_soft_size=0.2), "Point", location=(-0.8, -1, 1.2))


@case
def plane_ahead():
    """At distance 10, facing the camera, filling the view."""
    shown(quad(scale=(20, 20, 1), rotation_euler=TOWARDS_CAMERA), emission=EMISSION)


@case
def plane_ahead_orthographic():
    plane_ahead()
    bpy.context.scene.camera.data.type = "ORTHO"


def tilted():
    return shown(quad(scale=(40, 40, 1), rotation_euler=(0.9, 0.0, 0.2)), emission=EMISSION)


@case
def plane_tilted():
    tilted()


@case
def plane_tilted_shifted():
    tilted()
    camera = bpy.context.scene.camera.data
    camera.shift_x, camera.shift_y = 0.25, -0.4


@case
def plane_tilted_orthographic():
    tilted()
    camera = bpy.context.scene.camera.data
    camera.type, camera.ortho_scale, camera.shift_x, camera.shift_y = "ORTHO", 5.0, -0.2, 0.3


@case
def clipped():
    """Three planes; the nearest lies before clip_start, the third beyond clip_end."""
    for name, y, x, colour in (("Near", -8, 0, (1, 0, 0)), ("Middle", 0, -21, (0, 1, 0)),
                               ("Far", 5, 0, (0, 0, 1))):
        shown(quad(name, scale=(20, 20, 1), location=(x, y, 0), rotation_euler=TOWARDS_CAMERA),
              emission=colour)
    camera = bpy.context.scene.camera.data
    camera.clip_start, camera.clip_end = 3.0, 12.0
    bpy.context.scene.world.color = (0.1, 0.1, 0.1)


@case
def clipped_orthographic():
    clipped()
    bpy.context.scene.camera.data.type = "ORTHO"


@case
def lit_by_sun():
    """Radiance of a diffuse plane under E W/m2 at an angle: albedo E cos / pi."""
    shown(quad(scale=(20, 20, 1), rotation_euler=TOWARDS_CAMERA), albedo=(0.2, 0.5, 0.8))
    sun(4.0, (math.pi / 2 - math.pi / 3, 0.0, 0.0))


def ball(name, **attributes):
    mesh = bpy.data.meshes.new(name)
    import bmesh
    edit = bmesh.new()
    bmesh.ops.create_icosphere(edit, subdivisions=4, radius=1.0)
    edit.to_mesh(mesh)
    edit.free()
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    return link(mesh, name, **attributes)


@case
def smooth_ball():
    ball("Ball")
    sun(1.0)


@case
def smooth_ball_mirrored():
    ball("Ball", scale=(-1, 1, 1), rotation_euler=(0.3, 0.4, 0.5))
    sun(1.0)


def half_covered():
    """An emitting plane whose edge runs slantwise through the picture's middle."""
    shown(quad(scale=(10, 20, 1), location=(-10 * math.cos(0.1), 0, 10 * math.sin(0.1)),
               rotation_euler=(math.pi / 2, 0.1, 0.0)), emission=EMISSION)
    bpy.context.scene.world.color = (0.4, 0.8, 1.2)


@case
def film_opaque():
    half_covered()


@case
def film_transparent():
    half_covered()
    bpy.context.scene.render.film_transparent = True


@case
def world_nodes():
    shown(quad(scale=(0.1, 0.1, 0.1), rotation_euler=TOWARDS_CAMERA), emission=EMISSION)
    world = bpy.context.scene.world
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0.1, 0.2, 0.3, 1.0)
    background.inputs["Strength"].default_value = 2.0


@case
def full_frame():
    room()


def border(crop):
    room()
    render = bpy.context.scene.render
    render.use_border, render.use_crop_to_border = True, crop
    render.border_min_x, render.border_max_x = 0.25, 0.75
    render.border_min_y, render.border_max_y = 0.5, 0.875


@case
def border_cropped():
    border(crop=True)


@case
def border_uncropped():
    border(crop=False)


@case
def half_resolution():
    room()
    bpy.context.scene.render.resolution_percentage = 50


def report_of(case_name):
    return json.loads((FOLDER / f"{case_name}.json").read_text())


def render(name):
    scene = bpy.context.scene
    if scene.render.engine != "CYCLES":
        scene.render.engine = "ANTIRADIANCE"
        scene.antiradiance.report_path = str(FOLDER / f"{name}.json")
    for layer in scene.view_layers:
        layer.use_pass_z = layer.use_pass_normal = True
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.color_depth = "32"
    scene.render.use_file_extension = False
    scene.render.filepath = str(FOLDER / f"{name}.exr")
    bpy.ops.render.render(write_still=True)


def lamp_ahead(light, visible):
    """The lamp before a black wall, seen from the front."""
    shown(quad(scale=(20, 20, 1), rotation_euler=TOWARDS_CAMERA, location=(0, 3, 0)),
          albedo=(0.0, 0.0, 0.0))
    thing = link(light, "Lamp", rotation_euler=TOWARDS_CAMERA)
    if light.type in {"AREA", "SPOT"}:
        thing.rotation_euler = (-math.pi / 2, 0, 0)  # they shine along their -Z: to the camera
    thing.visible_camera = visible


def as_cycles(name):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 64
    scene.cycles.use_denoising = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 1.0
    render(name)


SEEN_LAMPS = {
    "seen_point": ("POINT", 500.0, {"shadow_soft_size": 1.0}),
    "seen_spot": ("SPOT", 500.0, {"shadow_soft_size": 1.0, "spot_size": 1.2}),
    "seen_square": ("AREA", 500.0, {"size": 2.0}),
    "seen_ellipse": ("AREA", 500.0, {"shape": "ELLIPSE", "size": 3.0, "size_y": 1.5}),
}


def seen_lamps():
    for name, (kind, energy, settings) in SEEN_LAMPS.items():
        for suffix, visible in (("", True), ("_hidden", False)):
            recorder.empty_scene()
            lamp_ahead(lamp(kind, energy, **settings), visible)
            render(name + suffix)
        bpy.context.scene.objects["Lamp"].visible_camera = True
        as_cycles(name + "_cycles")


def back_ends():
    """One room by both solvers, in both modes, until converged and in 4 passes."""
    recorder.empty_scene()
    room()
    settings = bpy.context.scene.antiradiance
    settings.direction_bins = 64
    settings.display = "PATCHES"  # the solution itself: shooting adds a bounce
    reports = {}
    for visibility in ("EXPLICIT", "IMPLICIT"):
        for iterations in (0, 4):
            for solver in ("CPU", "OPENGL"):
                settings.visibility, settings.iterations = visibility, iterations
                settings.solver = solver
                name = f"{visibility}_{iterations}_{solver}"
                render(name)
                reports[name] = report_of(name)
    return reports


def animation():
    """The lamp burns at 100 W in frame 1 and at 200 W in frame 2; then with persistent data."""
    recorder.empty_scene()
    room()
    light = bpy.data.objects["Point"].data
    for frame, energy in ((1, 100.0), (2, 200.0)):
        light.energy = energy
        light.keyframe_insert("energy", frame=frame)
    block = bpy.data.objects["Block"]
    for frame, x in ((1, -0.5), (2, 0.5)):
        block.location.x = x
        block.keyframe_insert("location", frame=frame)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 2
    render("animation_still")  # sets the output up
    scene.render.use_file_extension = True
    for persistent in (False, True):
        scene.render.use_persistent_data = persistent
        name = "persistent_" if persistent else "animation_"
        scene.render.filepath = str(FOLDER / name)
        bpy.ops.render.render(animation=True)


def view_layers():
    """Red is in the first layer only, green in the second only."""
    recorder.empty_scene()
    scene = bpy.context.scene
    scene.view_layers[0].name = "First"
    second = scene.view_layers.new("Second")
    for name, colour, owner in (("Red", (1, 0, 0), scene.view_layers["First"]),
                                ("Green", (0, 1, 0), second)):
        collection = bpy.data.collections.new(name)
        scene.collection.children.link(collection)
        thing = shown(quad(name, scale=(20, 20, 1), rotation_euler=TOWARDS_CAMERA), emission=colour)
        scene.collection.objects.unlink(thing)
        collection.objects.link(thing)
        for layer in scene.view_layers:
            layer.layer_collection.children[name].exclude = layer != owner
    render("view_layers")


def stereo():
    """A wall 10 m away seen by two eyes 2 m apart, parallel: its edge at x = 0 moves by 1 / 10."""
    recorder.empty_scene()
    shown(quad(scale=(10, 20, 1), location=(-10, 0, 0), rotation_euler=TOWARDS_CAMERA),
          emission=EMISSION)
    scene = bpy.context.scene
    scene.camera.data.stereo.convergence_mode = "PARALLEL"
    scene.camera.data.stereo.interocular_distance = 2.0
    scene.camera.data.stereo.pivot = "CENTER"
    scene.render.use_multiview = True
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.views_format = "MULTIVIEW"
    render("stereo")


def compositor():
    """The Depth pass has a socket that a compositor can use."""
    recorder.empty_scene()
    plane_ahead()
    scene = bpy.context.scene
    scene.view_layers[0].use_pass_z = True
    scene.render.engine = "ANTIRADIANCE"
    if hasattr(scene, "compositing_node_group"):  # 5.0
        return {"skipped": "compositor trees of Blender 5"}
    scene.use_nodes = True
    tree = scene.node_tree
    tree.nodes.clear()
    source = tree.nodes.new("CompositorNodeRLayers")
    target = tree.nodes.new("CompositorNodeComposite")
    tree.links.new(source.outputs["Depth"], target.inputs["Image"])
    render("compositor")
    return {"sockets": [socket.name for socket in source.outputs if socket.enabled]}


def camera_of():
    data = bpy.context.scene.camera.data
    render_settings = bpy.context.scene.render
    return {"type": data.type, "half_width": 0.5 * data.sensor_width / data.lens,
            "ortho_scale": data.ortho_scale, "shift": (data.shift_x, data.shift_y),
            "width": render_settings.resolution_x, "height": render_settings.resolution_y}


def run(name, build):
    recorder.empty_scene()
    build()
    render(name)
    normal = None
    if "Quad" in bpy.data.objects:
        normal = bpy.data.objects["Quad"].matrix_world.to_3x3().col[2].normalized()
    return {"report": report_of(name), "camera": camera_of(), "normal": normal}


results = {name: run(name, build) for name, build in CASES.items()}
seen_lamps()
results["back_ends"] = back_ends()
animation()
view_layers()
stereo()
results["compositor"] = compositor()
recorder.finish(results)
