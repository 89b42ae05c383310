# SPDX-License-Identifier: GPL-3.0-or-later
"""Blocking planes in the 3D viewports: translucent, outlined, with the number of links they cut.

What is drawn is what the viewport's depsgraph holds, as sync reads it for a render: modifiers,
animation and instances included. Nothing is kept between two redraws, and no data is written.
"""
from dataclasses import dataclass

import blf
import bpy
import gpu
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix, Vector

from . import blockers, render_log
from .sync import display_name
from .ui import ENGINE

RED, GREY = (1.0, 0.08, 0.05), (0.85, 0.85, 0.85)
FILL_ALPHA = 0.35
FAINT = 0.4       # of the alpha, of planes that take no part
BEHIND = 0.5      # of the alpha, of what is behind a surface
# What a plane is lifted towards the eye, so that one on a surface is not half behind it: of the
# depth from -1 to 1. Ten metres away and at Blender's own clip start, 1 cm.
LIFT = 2e-6
LINE_WIDTH = 2.0  # px at Blender's own scale, as the size of the text
TEXT_SIZE = 11.0

_handlers = []


@dataclass(frozen=True, eq=False)
class Plane:
    """One instance of a blocking plane, as a viewport sees it."""
    name: str              # display_name()
    positions: np.ndarray  # (#vertices, 3) f32, object space
    triangles: np.ndarray  # (#triangles, 3) i32
    outline: np.ndarray    # (#edges, 2) i32
    matrix: Matrix
    mute: bool
    solo: bool
    visible: bool          # in this viewport
    selected: bool
    active: bool


def draws_in(context) -> bool:
    """Whether this viewport shows blocking planes at all."""
    return (context.engine == ENGINE and context.space_data.overlay.show_overlays
            and context.scene.antiradiance_blockers.show_blockers
            and any(blockers.is_blocker(thing) for thing in bpy.data.objects))


def planes_in(context) -> list[Plane]:
    planes, view_layer = [], context.view_layer
    for instance in context.evaluated_depsgraph_get().object_instances:
        item = instance.object  # valid until the iterator moves on
        if not (instance.show_self and blockers.is_blocker(item)):
            continue
        # An instance is hidden, and selected, with the object that makes it.
        owner = (instance.parent if instance.is_instance else item).original
        part = item.antiradiance
        planes.append(Plane(
            display_name(instance), *surface_of(item), instance.matrix_world.copy(), part.mute,
            part.solo, owner.visible_get(view_layer=view_layer, viewport=context.space_data),
            owner.select_get(), owner == view_layer.objects.active))
    return planes


def surface_of(item):
    """(positions, triangles, outline) of the evaluated object, also while it is being edited."""
    mesh = item.to_mesh()
    try:
        mesh.calc_loop_triangles()
        positions = np.empty((len(mesh.vertices), 3), np.float32)
        triangles = np.empty((len(mesh.loop_triangles), 3), np.int32)
        edges = np.empty((len(mesh.edges), 2), np.int32)
        edge_of_loop = np.empty(len(mesh.loops), np.int32)
        mesh.vertices.foreach_get("co", positions.reshape(-1))
        mesh.loop_triangles.foreach_get("vertices", triangles.reshape(-1))
        mesh.edges.foreach_get("vertices", edges.reshape(-1))
        mesh.loops.foreach_get("edge_index", edge_of_loop)
    finally:
        item.to_mesh_clear()
    faces_at = np.bincount(edge_of_loop, minlength=len(edges))
    return positions, triangles, edges[faces_at == 1]


def draw_planes():
    context = bpy.context
    if not draws_in(context):
        return
    planes = planes_in(context)
    take_part = blockers.taking_part(planes)
    theme = context.preferences.themes[0].view_3d
    width = LINE_WIDTH * context.preferences.system.ui_scale
    lifted = gpu.matrix.get_projection_matrix()
    lifted[2] -= LIFT * lifted[3]
    blend, depth_test = gpu.state.blend_get(), gpu.state.depth_test_get()
    gpu.state.blend_set("ALPHA")
    try:
        for plane in planes:
            if not plane.visible or not len(plane.triangles):
                continue
            strength, color = (1.0, RED) if plane in take_part else (FAINT, GREY)
            rim = (color if not plane.selected
                   else theme.object_active if plane.active else theme.object_selected)
            with gpu.matrix.push_pop(), gpu.matrix.push_pop_projection():
                gpu.matrix.multiply_matrix(plane.matrix)
                gpu.matrix.load_projection_matrix(lifted)
                # Planes lie inside of walls: what those hide is seen through them.
                for test, share in (("LESS_EQUAL", 1.0), ("GREATER", BEHIND)):
                    gpu.state.depth_test_set(test)
                    draw_fill(plane, (*color, FILL_ALPHA * strength * share))
                    draw_outline(plane, (*rim, strength * share), width)
    finally:
        gpu.state.blend_set(blend)
        gpu.state.depth_test_set(depth_test)


def draw_fill(plane, rgba):
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    shader.uniform_float("color", rgba)
    batch_for_shader(shader, "TRIS", {"pos": plane.positions}, indices=plane.triangles).draw(shader)


def draw_outline(plane, rgba, width):
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    shader.uniform_float("color", rgba)
    shader.uniform_float("lineWidth", width)
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    batch_for_shader(shader, "LINES", {"pos": plane.positions}, indices=plane.outline).draw(shader)


def draw_labels():
    context = bpy.context
    if not (draws_in(context) and context.space_data.overlay.show_text):
        return
    cut = {plane["name"]: plane["links_cut"]
           for plane in render_log.planes_of_last(context.scene.name)}
    scale, font = context.preferences.system.ui_scale, 0
    blf.size(font, TEXT_SIZE * scale)
    blf.color(font, 1.0, 1.0, 1.0, 1.0)
    blf.enable(font, blf.SHADOW)
    blf.shadow(font, 3, 0.0, 0.0, 0.0, 1.0)
    for plane in planes_in(context):
        if plane.name not in cut or not plane.visible or not len(plane.positions):
            continue
        centre = Vector((plane.positions.min(axis=0) + plane.positions.max(axis=0)) / 2)
        place = location_3d_to_region_2d(context.region, context.region_data, plane.matrix @ centre)
        if place is not None:
            text = f"{cut[plane.name]:,} links cut"
            width, height = blf.dimensions(font, text)
            blf.position(font, place.x - width / 2, place.y - height / 2, 0)
            blf.draw(font, text)
    blf.disable(font, blf.SHADOW)


def register():
    if bpy.app.background:  # there is no view to draw in, and no `gpu`
        return
    for draw, when in ((draw_planes, "POST_VIEW"), (draw_labels, "POST_PIXEL")):
        _handlers.append(bpy.types.SpaceView3D.draw_handler_add(draw, (), "WINDOW", when))


def unregister():
    for handler in _handlers:
        bpy.types.SpaceView3D.draw_handler_remove(handler, "WINDOW")
    _handlers.clear()
