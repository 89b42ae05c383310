# SPDX-License-Identifier: GPL-3.0-or-later
"""For the scripts of this folder: a scene that records what sync writes, and small scene builders.

Runs inside Blender with the add-on enabled; needs nothing of the native module.
"""

import importlib
import json
import sys

import bpy
import numpy as np


def addon(name):
    """A module of the enabled add-on, whichever way it was installed."""
    package = next(m for m in sys.modules if m.split(".")[-1] == "antiradiance")
    return importlib.import_module(f"{package}.{name}")


def arguments():
    """What stands after `-- RESULT.json`."""
    return sys.argv[sys.argv.index("--") + 2 :]


def finish(result):
    with open(sys.argv[sys.argv.index("--") + 1], "w", encoding="utf-8") as file:
        json.dump(result, file, default=as_json)


def as_json(value):
    return value.tolist() if isinstance(value, (np.ndarray, np.generic)) else list(value)


class RecordingScene:
    """The native Scene's methods, recorded."""

    def __init__(self):
        self.textures, self.materials, self.meshes, self.lamps = [], [], [], []
        self.blockers = []
        self.camera = self.background = None

    def add_texture(self, name, pixels):
        assert pixels.dtype == np.float32 and pixels.ndim == 3 and pixels.shape[2] == 4
        self.textures.append({"name": name, "pixels": pixels})
        return len(self.textures) - 1

    def add_missing_texture(self, name, path):
        self.textures.append({"name": name, "missing": path})
        return len(self.textures) - 1

    def add_material(self, name, **values):
        self.materials.append({"name": name, **values})
        return len(self.materials) - 1

    def add_mesh(self, object_name, **arrays):
        count = len(arrays["triangles"])
        wanted = {"positions": (np.float32, (len(arrays["positions"]), 3)),
                  "triangles": (np.int32, (count, 3)), "triangle_polygon": (np.int32, (count,)),
                  "triangle_material": (np.int32, (count,)), "uv": (np.float32, (count, 3, 2)),
                  "corner_normals": (np.float32, (count, 3, 3)), "matrix": (np.float32, (4, 4))}
        for name, (dtype, shape) in wanted.items():
            array = arrays[name]
            if array is not None:
                assert array.dtype == dtype and array.shape == shape, (name, array.dtype, array.shape)
                assert array.flags.c_contiguous, name
        self.meshes.append({"name": object_name, **arrays})
        return len(self.meshes) - 1

    def add_blocker(self, name, *, positions, matrix, triangles):
        for array, dtype, width in ((positions, np.float32, 3), (matrix, np.float32, 4),
                                    (triangles, np.int32, 3)):
            assert array.dtype == dtype and array.shape == (len(array), width), name
            assert array.flags.c_contiguous, name
        self.blockers.append({"name": name, "positions": positions, "matrix": matrix,
                              "triangles": triangles})
        return len(self.blockers) - 1

    def add_lamp(self, name, **settings):
        self.lamps.append({"name": name, **settings})
        return len(self.lamps) - 1

    def set_camera(self, matrix, **settings):
        self.camera = {"matrix": matrix, **settings}

    def set_background(self, radiance):
        self.background = radiance


def sync():
    """(RecordingScene, warnings) of the current scene, evaluated as for a render."""
    recorded = {}

    class Probe(bpy.types.RenderEngine):
        bl_idname = "ANTIRADIANCE_PROBE"
        bl_label = "Probe"

        def render(self, depsgraph):
            scene, warnings = RecordingScene(), []
            try:
                addon("sync").SceneWriter(scene, warnings.append).write(depsgraph)
                camera = addon("camera")
                frame = camera.frame_of(depsgraph.scene.render, self.resolution_x, self.resolution_y)
                camera.set_camera(scene, self, depsgraph, depsgraph.scene.camera, frame)
                recorded["result"] = scene, warnings
            except Exception as error:
                recorded["error"] = error

    bpy.utils.register_class(Probe)
    render = bpy.context.scene.render
    before = render.engine
    render.engine = Probe.bl_idname
    bpy.ops.render.render()
    render.engine = before
    bpy.utils.unregister_class(Probe)
    if "error" in recorded:
        raise recorded["error"]
    return recorded["result"]


def empty_scene():
    """A scene with nothing but a camera at (0, -10, 0) that looks along +Y, and a black world."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)  # keeps add-ons enabled
    scene = bpy.context.scene
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location = (0.0, -10.0, 0.0)
    camera.rotation_euler = (np.pi / 2, 0.0, 0.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.world = bpy.data.worlds.new("World")
    scene.world.color = (0.0, 0.0, 0.0)
    scene.render.resolution_x, scene.render.resolution_y = 64, 48
    return scene


def link(data, name, **attributes):
    """A new object of `data` in the scene."""
    thing = bpy.data.objects.new(name, data)
    for attribute, value in attributes.items():
        setattr(thing, attribute, value)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def cube(name="Cube", size=2.0, **attributes):
    """An axis-aligned cube of six quads about the origin of its object."""
    half = size / 2
    corners = [(x, y, z) for x in (-half, half) for y in (-half, half) for z in (-half, half)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], faces)
    return link(mesh, name, **attributes)


def blocker(name="Plane", mute=False, solo=False, **attributes):
    """A quad() that is a blocking plane."""
    thing = quad(name, **attributes)
    part = thing.antiradiance
    part.is_blocker, part.mute, part.solo = True, mute, solo
    return thing


def quad(name="Quad", **attributes):
    """The square (-1..1, -1..1, 0) that faces +Z, with the unit square as its UV map."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
    layer = mesh.uv_layers.new(name="UVMap")
    for loop, uv in zip(layer.data, ((0, 0), (1, 0), (1, 1), (0, 1))):
        loop.uv = uv
    return link(mesh, name, **attributes)


def material(name, albedo=None, emission=None):
    """A Diffuse BSDF of `albedo`, or an Emission shader of radiance `emission`."""
    surface = bpy.data.materials.new(name)
    surface.use_nodes = True
    tree = surface.node_tree
    tree.nodes.clear()
    node = tree.nodes.new("ShaderNodeEmission" if emission else "ShaderNodeBsdfDiffuse")
    node.inputs["Color"].default_value = (*(emission or albedo), 1.0)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    return surface


def world_positions(mesh):
    """(#vertices, 3) of what add_mesh() or add_blocker() got."""
    matrix = mesh["matrix"].astype(float)
    return mesh["positions"].astype(float) @ matrix[:3, :3].T + matrix[:3, 3]


def blockers_of(scene):
    """Blocking planes as {"name", "triangles", "low", "high"} with world-space extents."""
    return [{"name": plane["name"], "triangles": len(plane["triangles"]),
             "low": world_positions(plane).min(axis=0), "high": world_positions(plane).max(axis=0)}
            for plane in scene.blockers]


def summary(scene):
    """Meshes as {"name", "triangles", "polygons", "low", "high", ...} with world-space extents."""
    result = []
    for mesh in scene.meshes:
        world = world_positions(mesh)
        used = world[np.unique(mesh["triangles"])]
        corners = world[mesh["triangles"]]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        result.append({
            "name": mesh["name"], "triangles": len(mesh["triangles"]),
            "polygons": len(np.unique(mesh["triangle_polygon"])),
            "low": used.min(axis=0), "high": used.max(axis=0),
            "area": 0.5 * np.linalg.norm(normals, axis=1).sum(),
            "determinant": np.linalg.det(mesh["matrix"].astype(float)[:3, :3]),
            "smooth": mesh["corner_normals"] is not None,
            "uv": mesh["uv"], "array": id(mesh["positions"]),
            "materials": [scene.materials[i]["name"] for i in mesh["slot_materials"]],
            "slots": np.unique(mesh["triangle_material"]),
        })
    return result
