# SPDX-License-Identifier: GPL-3.0-or-later
"""Panels: the engine's own, and Blender's that show what the engine reads."""
import textwrap

import bpy

from . import compat, core, presets, render_log
from .properties import option_values

ENGINE = "ANTIRADIANCE"

# Which panel shows which option; an option that no panel names shows up in the last one.
PANEL_OPTIONS = {
    "solution": ("visibility", "direct_light", "direct_samples"),
    "link_mesh": ("max_patch_size", "link_threshold", "direction_bins", "visibility_rays",
                  "ray_budget", "pruning", "pruning_directions", "remove_dark_links",
                  "evaluate_pruning"),
    "solver": ("solver", "iterations"),
    "display": ("display", "shooting_level", "shooting_visibility", "shooting_samples",
                "interleave", "bin_map_size"),
    "report": ("report_path",),
}

# Panels for BLENDER_RENDER whose settings the engine does not read.
NOT_BORROWED = {
    "DATA_PT_area", "DATA_PT_falloff_curve", "DATA_PT_light", "DATA_PT_spot",
    "RENDER_PT_color_management_curves", "RENDER_PT_freestyle", "RENDER_PT_simplify_greasepencil",
    "RENDER_PT_stamp_burn", "VIEWLAYER_PT_filter", "VIEWLAYER_PT_layer_passes",
    "VIEWLAYER_PT_freestyle",
}


def options_of(panel: str):
    """Names of the options that a panel shows, in its order."""
    known = [option["name"] for option in core.native.options_schema()]
    shown = [name for name in PANEL_OPTIONS[panel] if name in known]
    if panel == list(PANEL_OPTIONS)[-1]:
        placed = {name for names in PANEL_OPTIONS.values() for name in names}
        shown += [name for name in known if name not in placed]
    return shown


class EnginePanel:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    COMPAT_ENGINES = {ENGINE}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES


class OptionsPanel(EnginePanel):
    options: str  # key of PANEL_OPTIONS

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        settings = context.scene.antiradiance
        active = core.native.active_options(option_values(settings))
        column = layout.column()
        for name in options_of(self.options):
            row = column.row()
            row.active = name in active
            row.prop(settings, name)


class RENDER_PT_antiradiance_solution(OptionsPanel, bpy.types.Panel):
    bl_label = "Solution"
    options = "solution"

    def draw_header_preset(self, _context):
        presets.RENDER_PT_antiradiance_presets.draw_panel_header(self.layout)


class RENDER_PT_antiradiance_link_mesh(OptionsPanel, bpy.types.Panel):
    bl_label = "Link Mesh"
    options = "link_mesh"


class RENDER_PT_antiradiance_solver(OptionsPanel, bpy.types.Panel):
    bl_label = "Solver"
    bl_options = {"DEFAULT_CLOSED"}
    options = "solver"


class RENDER_PT_antiradiance_display(OptionsPanel, bpy.types.Panel):
    bl_label = "Display"
    options = "display"


class RENDER_PT_antiradiance_film(EnginePanel, bpy.types.Panel):
    bl_label = "Film"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        self.layout.prop(context.scene.render, "film_transparent", text="Transparent")


class RENDER_PT_antiradiance_performance(EnginePanel, bpy.types.Panel):
    bl_label = "Performance"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        self.layout.prop(context.scene.render, "use_persistent_data", text="Persistent Data")


class RENDER_PT_antiradiance_report(OptionsPanel, bpy.types.Panel):
    bl_label = "Report"
    options = "report"

    def draw(self, context):
        super().draw(context)
        outcome = render_log.last(context.scene.name)
        if outcome is None:
            self.layout.label(text="Not rendered yet", icon="INFO")
            return
        if outcome.error:
            draw_message(self.layout, context, outcome.error, "ERROR")
        else:
            draw_figures(self.layout, outcome.report)
        for warning in outcome.warnings:
            draw_message(self.layout, context, warning, "ERROR" if outcome.error else "INFO")


def draw_figures(layout, report):
    solve, times, links = report["solve"], report["timings_s"], report["links"]
    display = report["display"]
    state = "converged" if solve["converged"] else "not converged"
    rows = (
        ("Patches", f"{report['patches']:,} ({report['leaves']:,} leaves)"),
        ("Links", f"{links['total']:,}"),
        ("Iterations", f"{solve['iterations']}, {state}"),
        ("Solver", solve["renderer"] or solve["backend"]),
        ("Display", display["renderer"] or display["backend"]),
        ("Time", f"{times['total']:.1f} s (solve {times['solve']:.1f} s)"),
        ("Kept", kept_stages(report) or "nothing"),
        ("Peak Memory", f"{report['peak_memory_bytes'] / 2**20:,.0f} MiB"),
    )
    grid = layout.box().column(align=True)
    for label, value in rows:
        split = grid.split(factor=0.4)
        left = split.row()
        left.alignment = "RIGHT"
        left.label(text=label)
        split.label(text=value)


def kept_stages(report):
    """Names of the stages that an earlier render had done, "" if there are none."""
    return ", ".join(name.replace("_", " ") for name, what in report["stages"].items()
                     if what == "kept")


def draw_message(layout, context, text, icon):
    """Labels do not wrap by themselves. A character takes about 7 pixels at scale 1."""
    width = context.region.width / (7 * context.preferences.system.ui_scale) - 8
    box = layout.box().column(align=True)
    for paragraph in text.splitlines():
        for line in textwrap.wrap(paragraph, max(20, int(width))) or [""]:
            box.label(text=line, icon=icon)
            icon = "BLANK1"


class VIEWLAYER_PT_antiradiance_passes(EnginePanel, bpy.types.Panel):
    bl_label = "Passes"
    bl_context = "view_layer"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        column = layout.column(heading="Include")
        column.prop(context.view_layer, "use_pass_combined")
        column.prop(context.view_layer, "use_pass_z")
        column.prop(context.view_layer, "use_pass_normal")


class DATA_PT_antiradiance_light(EnginePanel, bpy.types.Panel):
    bl_label = "Light"
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.light is not None

    def draw(self, context):
        light, layout = context.light, self.layout
        layout.row().prop(light, "type", expand=True)
        layout.use_property_split = True
        column = layout.column()
        for name in ("use_temperature", "temperature"):
            if hasattr(light, name):
                column.prop(light, name)
        column.prop(light, "color")
        column.prop(light, "energy", text="Strength" if light.type == "SUN" else "Power")
        for name in ("exposure", "normalize"):
            if hasattr(light, name):
                column.prop(light, name)
        column.separator()
        DRAW_SHAPE[light.type](column, light)
        if context.object is not None and context.object.data == light:
            column.prop(context.object, "visible_camera", text="Visible to Camera")


def draw_point(column, light):
    column.prop(light, "shadow_soft_size", text="Radius")


def draw_spot(column, light):
    draw_point(column, light)
    column.prop(light, "spot_size", text="Spot Size")
    column.prop(light, "spot_blend", text="Blend", slider=True)
    column.prop(light, "show_cone")


def draw_sun(column, light):
    column.prop(light, "angle")


def draw_area(column, light):
    column.prop(light, "shape")
    if light.shape in {"RECTANGLE", "ELLIPSE"}:
        sub = column.column(align=True)
        sub.prop(light, "size", text="Size X")
        sub.prop(light, "size_y", text="Y")
    else:
        column.prop(light, "size")
    column.prop(light, "spread")


DRAW_SHAPE = {"POINT": draw_point, "SPOT": draw_spot, "SUN": draw_sun, "AREA": draw_area}


class RENDER_PT_antiradiance_unusable(EnginePanel, bpy.types.Panel):
    bl_label = "Antiradiance cannot run"

    def draw(self, context):
        draw_message(self.layout, context, core.load_error, "ERROR")


class AntiradiancePreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    def draw(self, context):
        draw_message(self.layout, context, core.load_error, "ERROR")


CLASSES = (
    RENDER_PT_antiradiance_solution,
    RENDER_PT_antiradiance_link_mesh,
    RENDER_PT_antiradiance_solver,
    RENDER_PT_antiradiance_display,
    RENDER_PT_antiradiance_film,
    RENDER_PT_antiradiance_performance,
    RENDER_PT_antiradiance_report,
    VIEWLAYER_PT_antiradiance_passes,
    DATA_PT_antiradiance_light,
)
CLASSES_WITHOUT_CORE = (RENDER_PT_antiradiance_unusable, AntiradiancePreferences)


def borrowed_panels():
    """Blender's panels that the engine can show as they are."""
    for panel in bpy.types.Panel.__subclasses__():
        engines = getattr(panel, "COMPAT_ENGINES", None)
        if engines is None or panel.__name__ in NOT_BORROWED:
            continue
        if "BLENDER_RENDER" in engines or panel.__name__ in compat.BORROWED_PANELS:
            yield panel


def borrow_panels(engine):
    for panel in borrowed_panels():
        panel.COMPAT_ENGINES.add(engine)


def return_panels(engine):
    for panel in borrowed_panels():
        panel.COMPAT_ENGINES.discard(engine)
