# SPDX-License-Identifier: GPL-3.0-or-later
"""The evaluated depsgraph -> the core's scene. Arrays go through numpy, never element by element."""
from dataclasses import dataclass

import numpy as np

from . import compat
from .blockers import is_blocker, taking_part
from .images import read_pixels
from .lamps import add_lamp
from .materials import MaterialTable
from .world import set_background

# Geometry that has no surface of polygons. Curves, text and metaballs are not among them: the
# depsgraph hands their surface out as a mesh instance beside the object itself.
WITHOUT_SURFACE = {
    "CURVES": "hair curves are", "POINTCLOUD": "point clouds are", "VOLUME": "volumes are",
    "GPENCIL": "grease pencil is", "GREASEPENCIL": "grease pencil is",
}


class SyncCancelled(Exception):
    """The artist cancelled while the scene was being read."""


@dataclass
class MeshArrays:
    """One mesh, read once, shared by its instances."""
    positions: np.ndarray               # (#vertices, 3) f32, object space
    triangles: np.ndarray               # (#triangles, 3) i32, into positions
    polygons: np.ndarray                # (#triangles,) i32, n-gon of the mesh
    slots: np.ndarray                   # (#triangles,) i32, material slot
    corners: np.ndarray                 # (#triangles, 3) i32, into the mesh's loops
    corner_normals: np.ndarray | None   # (#triangles, 3, 3) f32, object space; None: flat
    uv_layers: dict[str, np.ndarray]    # name -> (#loops, 2) f32
    render_uv_layer: str                # "" if there is none


def read_mesh(mesh) -> MeshArrays:
    mesh.calc_loop_triangles()
    count = len(mesh.loop_triangles)
    positions = np.empty((len(mesh.vertices), 3), np.float32)
    mesh.vertices.foreach_get("co", positions.reshape(-1))
    triangles = np.empty((count, 3), np.int32)
    corners = np.empty((count, 3), np.int32)
    polygons = np.empty(count, np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles.reshape(-1))
    mesh.loop_triangles.foreach_get("loops", corners.reshape(-1))
    mesh.loop_triangles.foreach_get("polygon_index", polygons)
    polygon_slots = np.empty(len(mesh.polygons), np.int32)
    mesh.polygons.foreach_get("material_index", polygon_slots)
    normals = None
    if count and not compat.is_shaded_flat(mesh):
        normals = np.ascontiguousarray(compat.corner_normals(mesh)[corners])
    return MeshArrays(
        positions, triangles, polygons, polygon_slots[polygons], corners, normals,
        {layer.name: compat.uv_coordinates(layer) for layer in mesh.uv_layers},
        next((layer.name for layer in mesh.uv_layers if layer.active_render), ""))


def texture_coordinates(mesh: MeshArrays, materials, slots, warn_no_uv):
    """(#triangles, 3, 2) f32 for the textures of `materials` (one a slot), None if none has any.
    A UV map that the mesh lacks counts as 0, as in Cycles."""
    if not any(material.mapping for material in materials):
        return None
    uv = np.zeros((len(mesh.triangles), 3, 2), np.float32)
    for slot, material in enumerate(materials):
        chosen = slots == slot
        if material.mapping is None or not chosen.any():
            continue
        layer = mesh.uv_layers.get(material.mapping.uv_map or mesh.render_uv_layer)
        if layer is None:
            warn_no_uv(material)
            continue
        uv[chosen] = material.mapping.apply(layer[mesh.corners[chosen]])
    return uv


@dataclass
class Blocker:
    """An instance of a blocking plane; which of them take part is known when all are read."""
    name: str
    mesh: MeshArrays
    matrix: np.ndarray  # (4, 4) f32, object -> world space
    mute: bool
    solo: bool


class SceneWriter:
    """Adds what the depsgraph holds to `scene`, the core's (or one that records, in a test)."""

    def __init__(self, scene, warn, read=read_pixels):
        """read: of images, as read_pixels()"""
        self._scene = scene
        self._warn = warn
        self._read_image = read
        self._warned = set()
        self._materials = MaterialTable(scene, warn, read)
        self._meshes = {}  # pointer of the evaluated mesh -> MeshArrays; they live as long as we do
        self._blockers = []

    def warn_once(self, text):
        if text not in self._warned:
            self._warned.add(text)
            self._warn(text)

    def write(self, depsgraph, cancelled=lambda: False, shows=lambda _object: True):
        """All instances, lamps, the blocking planes that take part, and the world. shows(object):
        whether a viewport shows an evaluated object that the view layer shows."""
        override = depsgraph.view_layer_eval.material_override
        for instance in depsgraph.object_instances:
            if cancelled():
                raise SyncCancelled
            if instance.show_self and shows(instance.object):
                self._add(instance, override)
        for blocker in taking_part(self._blockers):
            self._scene.add_blocker(blocker.name, positions=blocker.mesh.positions,
                                    matrix=blocker.matrix, triangles=blocker.mesh.triangles)
        set_background(self._scene, depsgraph.scene.world, self.warn_once, self._read_image)

    def _add(self, instance, override):
        item = instance.object  # valid until the iterator moves on
        if item.type == "LIGHT":
            add_lamp(self._scene, display_name(instance), item, instance.matrix_world,
                     self.warn_once)
        elif is_blocker(item):
            settings = item.antiradiance
            self._blockers.append(Blocker(
                display_name(instance), self._read(item), matrix_of(instance), settings.mute,
                settings.solo))
        elif item.type == "MESH":
            self._add_mesh(instance, item, override)
        elif item.type in WITHOUT_SURFACE:
            self.warn_once(f"Object '{item.name}': {WITHOUT_SURFACE[item.type]} not rendered")
        if not instance.is_instance:
            self._note_hair(item)

    def _note_hair(self, item):
        if any(modifier.type == "PARTICLE_SYSTEM" and modifier.show_render
               and modifier.particle_system.settings.render_type == "PATH"
               for modifier in item.modifiers):
            self.warn_once(f"Object '{item.name}': its hair particles are not rendered")

    def _read(self, item) -> MeshArrays:
        mesh = item.data
        if mesh.is_editmode:  # its arrays are those from before the editing
            try:
                return read_mesh(item.to_mesh())
            finally:
                item.to_mesh_clear()
        key = mesh.as_pointer()
        if key not in self._meshes:
            self._meshes[key] = read_mesh(mesh)
        return self._meshes[key]

    def _add_mesh(self, instance, item, override):
        mesh = self._read(item)
        if not len(mesh.triangles):
            return  # vertices and edges only
        self._note_unsupported(item)
        slots = [slot.material for slot in item.material_slots] or [None]
        materials = [self._materials.add(override or material) for material in slots]
        # An index past the last slot shows the last material, as in Cycles.
        triangle_slots = np.minimum(mesh.slots, len(materials) - 1).astype(np.int32)

        def warn_no_uv(material):
            wanted = material.mapping.uv_map
            self.warn_once(
                f"Object '{item.name}': it has no UV map{f' {wanted!r}' if wanted else ''} for the "
                f"texture of the material '{material.name}', which is read at one point")

        self._scene.add_mesh(
            display_name(instance), positions=mesh.positions,
            matrix=matrix_of(instance), triangles=mesh.triangles,
            triangle_polygon=mesh.polygons, triangle_material=triangle_slots,
            slot_materials=[material.index for material in materials],
            uv=texture_coordinates(mesh, materials, triangle_slots, warn_no_uv),
            corner_normals=mesh.corner_normals)

    def _note_unsupported(self, item):
        for attribute, means in (("is_holdout", "a holdout"),
                                 ("is_shadow_catcher", "a shadow catcher")):
            if getattr(item, attribute, False):
                self.warn_once(f"Object '{item.name}': it is rendered as a surface, not as {means}")
        for attribute, means in (("visible_camera", "camera"), ("visible_diffuse", "diffuse"),
                                 ("visible_shadow", "shadow")):
            if not getattr(item, attribute, True):
                self.warn_once(f"Object '{item.name}': its ray visibility '{means}' is left out, "
                               "all rays see it")


def matrix_of(instance) -> np.ndarray:
    """(4, 4) f32, object -> world space"""
    # From 5.0 on, numpy would keep the order that Blender has its matrices in: column by column.
    return np.array(instance.matrix_world, np.float32, order="C")


def display_name(instance) -> str:
    """What an artist finds in the outliner: the object, and who instances it."""
    name = instance.object.name
    if instance.is_instance and instance.parent is not None and instance.parent.name != name:
        return f"{name} (instanced by {instance.parent.name})"
    return name
