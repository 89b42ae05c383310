# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes that cannot be rendered, or not as they are: what Blender and the artist are told.

argument: the folder for reports and pictures.
Result: {NAME: {"error": of the operator, "report": JSON or None, "picture": whether one was made}}.
"""

import json
import pathlib
import sys

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402
from recorder import cube, link, material, quad  # noqa: E402

FOLDER = pathlib.Path(recorder.arguments()[0])
CASES = {}


def case(build):
    CASES[build.__name__] = build
    return build


def lit_floor():
    """A good scene; each case spoils it."""
    lamp = bpy.data.lights.new("Lamp", "POINT")
    lamp.energy = 500.0
    link(lamp, "Lamp", location=(0, 0, 3))
    return quad("Floor", scale=(3, 3, 1))


def missing_image(thing):
    """The texture of a file that is not there, on `thing`."""
    surface = material(f"{thing.name} paint", albedo=(0.8, 0.8, 0.8))
    nodes = surface.node_tree.nodes
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = bpy.data.images.new(f"{thing.name} image", 4, 4)
    texture.image.source = "FILE"
    texture.image.filepath = str(FOLDER / "no such picture.png")
    texture.image.reload()
    shader = next(node for node in nodes if node.bl_idname == "ShaderNodeBsdfDiffuse")
    surface.node_tree.links.new(texture.outputs["Color"], shader.inputs["Color"])
    thing.data.materials.append(surface)


def spoil(thing, value):
    coordinates = np.empty(3 * len(thing.data.vertices), np.float32)
    thing.data.vertices.foreach_get("co", coordinates)
    coordinates[0] = value
    thing.data.vertices.foreach_set("co", coordinates)


@case
def no_geometry():
    bpy.data.objects.remove(lit_floor())


@case
def nan_coordinates():
    spoil(lit_floor(), np.nan)


@case
def infinite_coordinates():
    spoil(lit_floor(), np.inf)


@case
def flat_scale():
    """A matrix without an inverse: the object is a line."""
    lit_floor()
    cube("Line", scale=(1, 0, 0))


@case
def missing_texture():
    missing_image(lit_floor())


@case
def several_at_once():
    lit_floor()
    spoil(cube("Broken"), np.nan)
    missing_image(cube("Painted", location=(1, 0, 3)))


@case
def too_many_patches():
    lit_floor()
    bpy.context.scene.antiradiance.max_patch_size = 1e-5


@case
def report_in_no_folder():
    lit_floor()
    bpy.context.scene.antiradiance.report_path = str(FOLDER / "no such folder" / "report.json")


@case
def bug_in_the_addon():
    lit_floor()
    writer = recorder.addon("engine").SceneWriter
    write = writer.write

    def broken(*_):
        writer.write = write
        raise ZeroDivisionError("a bug")

    writer.write = broken


# The last render decides Blender's exit code: those that fail come first.


@case
def zero_area():
    """One triangle of the floor's mesh is a line; the rest renders."""
    floor = lit_floor()
    corners = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (0, 0, 1), (0, 0, 2), (0, 0, 3)]
    floor.data.clear_geometry()
    floor.data.from_pydata(corners, [], [(0, 1, 2, 3), (4, 5, 6)])


@case
def duplicate_faces():
    lit_floor()
    quad("Same floor", scale=(3, 3, 1))


@case
def bright_albedo():
    lit_floor().data.materials.append(material("Too bright", albedo=(1.5, 0.5, 0.5)))


@case
def no_light():
    lit_floor()
    bpy.data.objects.remove(bpy.data.objects["Lamp"])


def run(name, build):
    scene = recorder.empty_scene()
    scene.render.engine = "ANTIRADIANCE"
    report = FOLDER / f"{name}.json"
    scene.antiradiance.report_path = str(report)
    scene.camera.location.z, scene.camera.rotation_euler.x = 4.0, 1.2
    build()
    picture = FOLDER / f"{name}.exr"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.use_file_extension = False
    scene.render.filepath = str(picture)
    error = ""
    try:
        bpy.ops.render.render(write_still=True)
    except RuntimeError as failure:
        error = str(failure)
    return {"error": error, "picture": picture.is_file(),
            "report": json.loads(report.read_text()) if report.is_file() else None}


recorder.finish({name: run(name, build) for name, build in CASES.items()})
