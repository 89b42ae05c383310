# SPDX-License-Identifier: GPL-3.0-or-later
"""The blocking planes' list, panels and menu entries."""
import bpy

from . import blockers, render_log
from .blocker_evaluation import (
    ANTIRADIANCE_OT_evaluate_blocking_planes,
    guilty,
    totals,
    verdict,
)
from .blocker_operators import (
    ANTIRADIANCE_OT_add_blocking_plane,
    ANTIRADIANCE_OT_blocking_plane_from_face,
    ANTIRADIANCE_OT_clear_blocker,
    ANTIRADIANCE_OT_make_blocker,
)
from .ui import ENGINE, EnginePanel, draw_message

ADD = ANTIRADIANCE_OT_add_blocking_plane.bl_idname
MAKE = ANTIRADIANCE_OT_make_blocker.bl_idname
CLEAR = ANTIRADIANCE_OT_clear_blocker.bl_idname
FROM_FACE = ANTIRADIANCE_OT_blocking_plane_from_face.bl_idname
EVALUATE = ANTIRADIANCE_OT_evaluate_blocking_planes.bl_idname
PROPOSE = "antiradiance.propose_blocking_planes"

# The list's headings, at length.
WHAT = {"Cut": "Links Cut", "Blocked": "Blocked Anyway", "Wrong": "Cut Wrongly"}


def short(count: int) -> str:
    """In the four characters that a column has room for."""
    for unit, suffix in ((1e6, "M"), (1e3, "k")):
        if count >= unit:
            return f"{count / unit:.{0 if count >= 10 * unit else 1}f}{suffix}"
    return f"{count}"


def columns(context, name: str) -> list[tuple[str, int | None, bool]]:
    """(heading, number or None where it is not known, whether that is bad) for the object of that
    name: from the last render and, if there was one, the last evaluation."""
    scene_name = context.scene.name
    rendered = blockers.figures_of(name, render_log.planes_of_last(scene_name)) or {}
    shown = [("Cut", rendered.get("links_cut"), False)]
    evaluation = render_log.last_evaluation(scene_name)
    if evaluation is not None:
        judged = blockers.figures_of(name, evaluation["per_plane"]) or {}
        shown += [("Blocked", judged.get("occluded_cut"), False),
                  ("Wrong", judged.get("wrongly_cut"), bool(judged) and blockers.darkens(judged))]
    return shown


def draw_row(layout, shown):
    """(where the name goes, where the switches go); the figures, between them, in equal columns."""
    split = layout.split(factor=0.35)
    left, right = split.row(), split.row()
    figures = right.split()
    for text, alert in shown:
        cell = figures.row()
        cell.alignment = "RIGHT"
        cell.alert = alert
        cell.label(text=text)
    return left, right.row(align=True)


class ANTIRADIANCE_UL_blockers(bpy.types.UIList):
    """The blocking planes among a scene's objects"""

    def filter_items(self, _context, data, name):
        objects, helpers = getattr(data, name), bpy.types.UI_UL_list
        shown = self.bitflag_filter_item
        flags = (helpers.filter_items_by_name(self.filter_name, shown, objects)
                 or [shown] * len(objects))
        # Blender inverts these flags itself, if asked to; what is no plane stays hidden.
        hidden = shown if self.use_filter_invert else 0
        flags = [flag if blockers.is_blocker(thing) else hidden
                 for flag, thing in zip(flags, objects)]
        return flags, (helpers.sort_items_by_name(objects) if self.use_filter_sort_alpha else [])

    def draw_item(self, context, layout, scene, item, _icon, _active_data, _active_name):
        cells = [("" if number is None else short(number), bad)
                 for _heading, number, bad in columns(context, item.name)]
        name, switches = draw_row(layout, cells)
        name.active = blockers.takes_part(item, scene)
        name.alert = any(bad for _text, bad in cells)
        name.prop(item, "name", text="", emboss=False,
                  icon="ERROR" if name.alert else "MESH_PLANE")
        part = item.antiradiance
        switches.prop(part, "mute", text="", emboss=False,
                      icon="HIDE_ON" if part.mute else "HIDE_OFF")
        switches.prop(part, "solo", text="", emboss=False,
                      icon="SOLO_ON" if part.solo else "SOLO_OFF")


class RENDER_PT_antiradiance_blockers(EnginePanel, bpy.types.Panel):
    bl_label = "Blocking Planes"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, scene = self.layout, context.scene
        view, there = scene.antiradiance_blockers, blockers.of_scene(scene)
        layout.prop(view, "show_blockers")
        if there:
            column = layout.column(align=True)
            headings = [(heading, False) for heading, *_ in columns(context, "")]
            name, switches = draw_row(column, headings)
            name.label(text="Plane")
            switches.label(icon="BLANK1")
            switches.label(icon="BLANK1")
            column.template_list("ANTIRADIANCE_UL_blockers", "", scene, "objects", view,
                                 "active_index", rows=3, sort_lock=True)
        column = layout.column(align=True)
        row = column.row(align=True)
        row.operator(ADD, text="Add", icon="ADD")
        row.operator(FROM_FACE, text="From Face", icon="FACESEL")
        row = column.row(align=True)
        row.operator(MAKE, text="Make Selected")
        row.operator(CLEAR, text="Clear Selected")
        if is_registered(PROPOSE):
            layout.operator(PROPOSE)
        column = layout.column()
        column.enabled = bool(there)
        column.operator(EVALUATE)
        evaluation = render_log.last_evaluation(scene.name)
        if evaluation is not None:
            draw_message(layout, context, totals(evaluation), "INFO")
            draw_message(layout, context, verdict(evaluation),
                         "ERROR" if guilty(evaluation) else "CHECKMARK")


def is_registered(operator: str) -> bool:
    category, name = operator.split(".")
    return hasattr(bpy.types, f"{category.upper()}_OT_{name}")


class OBJECT_PT_antiradiance_blocking_plane(EnginePanel, bpy.types.Panel):
    bl_label = "Blocking Plane"
    bl_context = "object"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.object is not None and (
            context.object.type == "MESH")

    def draw_header(self, context):
        self.layout.prop(context.object.antiradiance, "is_blocker", text="")

    def draw(self, context):
        layout, thing = self.layout, context.object
        layout.use_property_split = True
        layout.active = thing.antiradiance.is_blocker
        column = layout.column(heading="Part")
        column.prop(thing.antiradiance, "mute")
        column.prop(thing.antiradiance, "solo")
        if not thing.antiradiance.is_blocker:
            return
        grid = layout.column(align=True)
        for heading, number, bad in columns(context, thing.name):
            split = grid.split(factor=0.4)
            left = split.row()
            left.alignment = "RIGHT"
            left.label(text=WHAT[heading])
            split.alert = bad
            split.label(text="Not known yet" if number is None else f"{number:,}",
                        icon="ERROR" if bad else "NONE")


def draw_add_menu(self, context):
    if context.engine == ENGINE:
        self.layout.separator()
        self.layout.operator(ADD, icon="MESH_PLANE")


def draw_object_menu(self, context):
    if context.engine == ENGINE:
        self.layout.separator()
        for operator in (MAKE, CLEAR, FROM_FACE):
            self.layout.operator(operator)


def draw_face_menu(self, context):
    if context.engine == ENGINE:
        self.layout.separator()
        self.layout.operator(FROM_FACE)


CLASSES = (ANTIRADIANCE_UL_blockers, RENDER_PT_antiradiance_blockers,
           OBJECT_PT_antiradiance_blocking_plane)
MENUS = (("VIEW3D_MT_mesh_add", draw_add_menu), ("VIEW3D_MT_object", draw_object_menu),
         ("VIEW3D_MT_edit_mesh_faces", draw_face_menu))


def register_menus():
    for menu, draw in MENUS:
        getattr(bpy.types, menu).append(draw)


def unregister_menus():
    for menu, draw in MENUS:
        getattr(bpy.types, menu).remove(draw)
