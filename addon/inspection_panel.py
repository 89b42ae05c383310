# SPDX-License-Identifier: GPL-3.0-or-later
"""The menu of a rendered viewport that says what it shows of its solution, and what that means."""
import textwrap

import bpy
import numpy as np
from mathutils import Color

from . import core, inspection, live, patch_links
from .patch_overlay import COLOURS
from .pick_patch import ANTIRADIANCE_OT_pick_patch
from .swatches import swatch

WIDTH = 14       # in Blender's units of the interface
CHARACTERS = 42  # that a line of that width holds


def viewport_in(area):
    """The Viewport of an area, the first of a quad view's; or None."""
    viewports = (live.viewport_at(region) for region in area.regions if region.type == "WINDOW")
    return next((viewport for viewport in viewports if viewport is not None), None)


class VIEW3D_PT_antiradiance_inspection(bpy.types.Panel):
    bl_label = "Inspect"
    bl_description = "What this viewport shows of the solution, and the links of a patch"
    bl_space_type = "VIEW_3D"
    bl_region_type = "HEADER"
    bl_ui_units_x = WIDTH

    @classmethod
    def poll(cls, context):
        return inspection.is_rendered(context)

    def draw(self, context):
        settings = context.space_data.shading.antiradiance
        viewport = viewport_in(context.area)
        solved = patch_links.solution_of(viewport)
        draw_view(self.layout, settings, solved)
        draw_legend(self.layout, settings, solved)
        self.layout.separator()
        draw_link_settings(self.layout, context, settings)
        patch = patch_links.links_in(viewport, context.scene, settings.links_shown)
        draw_kinds(self.layout, settings, patch)
        if patch is not None:
            draw_figures(self.layout, context.scene, patch)
        elif solved is not None and patch_links.place_in(context.scene) is not None:
            self.layout.label(text="No patch is left where you picked", icon="INFO")


def draw_view(layout, settings, solved):
    layout.label(text="View")
    layout.column(align=True).prop(settings, "view", expand=True)
    column = layout.column()
    draw_number(column, settings, "level", "HIERARCHY", solved and solved.level_count)
    draw_number(column, settings, "bin", "INCOMING_BIN", solved and solved.bin_count)


def draw_number(layout, settings, name, view, count):
    """count: how many there are, from 0 on; None: that is not known yet."""
    split = layout.split(factor=0.7)
    split.active = settings.view == view
    split.prop(settings, name)
    split.label(text="" if count is None else f"up to {count - 1}")


def draw_legend(layout, settings, solved):
    _label, tooltip = inspection.texts_of(settings)
    column = layout.box().column(align=True)
    for line in textwrap.wrap(tooltip, CHARACTERS):
        column.label(text=line)
    if settings.view == "INCOMING_BIN" and solved is not None:
        column.label(text=f"Light travels {direction(solved.bin_axis(settings.bin))}")
    for colour, meaning in core.native.inspect_legend(settings.view):
        on_screen = Color(np.clip(colour, 0.0, 1.0).tolist()).from_scene_linear_to_srgb()
        column.label(text=meaning, icon_value=swatch(on_screen))


def direction(axis) -> str:
    """(3,) in words that say where it mostly goes, and in numbers."""
    strongest = int(np.abs(axis).argmax())
    backward, forward = (("to -X", "to +X"), ("to -Y", "to +Y"), ("down", "up"))[strongest]
    word = forward if axis[strongest] > 0 else backward
    return f"{word} ({', '.join(f'{value:.2f}' for value in axis)})"


def draw_link_settings(layout, context, settings):
    overlays = context.space_data.overlay.show_overlays
    row = layout.row()
    row.active = overlays
    row.prop(settings, "show_links")
    if not overlays:
        layout.label(text="Viewport Overlays are off", icon="INFO")
    layout.operator(ANTIRADIANCE_OT_pick_patch.bl_idname, icon="EYEDROPPER")
    row = layout.row()
    row.active = settings.show_links
    row.prop(settings, "links_shown")


def draw_kinds(layout, settings, patch):
    column = layout.column(align=True)
    column.active = settings.show_links
    for number, (kind, _label, _tooltip) in enumerate(core.native.link_kinds()):
        split = column.split(factor=0.7, align=True)
        split.prop(settings, inspection.show_kind(kind), toggle=True,
                   icon_value=swatch(COLOURS[kind]))
        count = "" if patch is None else f"{np.count_nonzero(patch['kind'] == number):,}"
        split.label(text=count)


def draw_figures(layout, scene, patch):
    system = scene.unit_settings.system
    rows = (
        ("Links", f"{len(patch['kind']):,} of {patch['total']:,}"),
        ("Area", bpy.utils.units.to_string(system, "AREA", float(patch["area"]))),
        ("Centre", ", ".join(f"{value:.2f}" for value in patch["center"]) + " m"),
        ("Leaf", f"{patch['leaf']}"),
    )
    column = layout.box().column(align=True)
    for name, value in rows:
        split = column.split(factor=0.25)
        split.label(text=name)
        split.label(text=value)


def draw_button(header, context):
    if inspection.is_rendered(context):
        header.layout.popover(VIEW3D_PT_antiradiance_inspection.__name__, text="", icon="VIEWZOOM")


CLASSES = (VIEW3D_PT_antiradiance_inspection,)


def register_menus():
    bpy.types.VIEW3D_HT_header.append(draw_button)


def unregister_menus():
    bpy.types.VIEW3D_HT_header.remove(draw_button)
