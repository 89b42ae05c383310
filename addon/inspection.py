# SPDX-License-Identifier: GPL-3.0-or-later
"""What a 3D viewport shows of a solution: settings that lie with its other shading settings, so
that each viewport has its own and files keep them.
"""
import bpy

from . import core
from .ui import ENGINE


def _redraw(_settings, context):
    """Scripts change settings without a redraw; whose they are, a group does not know."""
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def show_kind(kind: str) -> str:
    """The name of the setting that shows links of a kind."""
    return f"show_{kind.lower()}"


def make_group(modes, kinds) -> type:
    """The PropertyGroup class. modes, kinds: (id, label, tooltip) each, of the core's
    inspect_modes() and link_kinds()."""
    # Explicit numbers: a file keeps its meaning when items are added between these.
    items = [(*mode, number) for number, mode in enumerate(modes)]
    annotations = {
        "view": bpy.props.EnumProperty(
            name="View", description="What this viewport shows of the solution", items=items,
            default=items[0][0], update=_redraw),
        "level": bpy.props.IntProperty(
            name="Level", description="Steps up the hierarchy from the smallest patches, which "
            "are level 0: larger patches, whole surfaces, clusters of surfaces",
            min=0, soft_max=20, update=_redraw),
        "bin": bpy.props.IntProperty(
            name="Bin", description="Number of the direction bin whose light is shown",
            min=0, soft_max=255, update=_redraw),
        "show_links": bpy.props.BoolProperty(
            name="Links of a Patch", description="Draw the links that bring light to the patch "
            "that was picked, and those that take it back. Links to a larger patch that it is a "
            "part of end at the middle of that one", update=_redraw),
        "links_shown": bpy.props.IntProperty(
            name="Links at Most", description="How many links are drawn: those that carry the most",
            default=300, min=1, soft_max=2000, max=10000, update=_redraw),
    }
    for kind, label, tooltip in kinds:
        annotations[show_kind(kind)] = bpy.props.BoolProperty(
            name=label, description=tooltip, default=True, update=_redraw)
    return type("AntiradianceInspection", (bpy.types.PropertyGroup,),
                {"__annotations__": annotations,
                 "__doc__": "What the Antiradiance engine shows of a solution in a viewport"})


def is_rendered(context) -> bool:
    """Whether the context's 3D viewport shows a solution."""
    return (context.engine == ENGINE and context.space_data.type == "VIEW_3D"
            and context.space_data.shading.type == "RENDERED")


def arguments(shading) -> tuple[str, int, int]:
    """Of LiveView.set_inspection()."""
    settings = shading.antiradiance
    return settings.view, settings.level, settings.bin


def texts_of(settings) -> tuple[str, str]:
    """(label, tooltip) of what a viewport's settings show."""
    return next(texts for mode, *texts in core.native.inspect_modes() if mode == settings.view)


def captioned(line: str, shading) -> str:
    """A viewport's status line that says what is seen, where it is not the picture."""
    settings = shading.antiradiance
    if settings.view == "OFF":
        return line
    number = {"HIERARCHY": f" {settings.level}", "INCOMING_BIN": f" {settings.bin}"}
    return f"{texts_of(settings)[0]}{number.get(settings.view, '')} · {line}"


def register_properties(group):
    bpy.types.View3DShading.antiradiance = bpy.props.PointerProperty(type=group)


def unregister_properties():
    del bpy.types.View3DShading.antiradiance
