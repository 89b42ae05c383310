# SPDX-License-Identifier: GPL-3.0-or-later
"""The artist's pause of a scene's viewports: a setting, and a button beside the shading modes."""
import bpy

from .ui import ENGINE


class AntiradianceViewport(bpy.types.PropertyGroup):
    """How the Antiradiance engine works in 3D viewports"""
    pause: bpy.props.BoolProperty(
        name="Pause", default=False,
        description="Let edits wait: the viewports keep the light that they have, from wherever "
                    "they look")


def draw_button(header, context):
    if context.engine == ENGINE and context.space_data.shading.type == "RENDERED":
        settings = context.scene.antiradiance_viewport
        header.layout.prop(settings, "pause", text="", icon="PLAY" if settings.pause else "PAUSE")


CLASSES = (AntiradianceViewport,)


def register_properties():
    bpy.types.Scene.antiradiance_viewport = bpy.props.PointerProperty(type=AntiradianceViewport)
    bpy.types.VIEW3D_HT_header.append(draw_button)


def unregister_properties():
    bpy.types.VIEW3D_HT_header.remove(draw_button)
    del bpy.types.Scene.antiradiance_viewport
