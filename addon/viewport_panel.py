# SPDX-License-Identifier: GPL-3.0-or-later
"""Render Properties > Viewport: the pause, and what the rendered viewports warn of."""
import bpy

from . import live
from .ui import EnginePanel, draw_message


class RENDER_PT_antiradiance_viewport(EnginePanel, bpy.types.Panel):
    bl_label = "Viewport"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(context.scene.antiradiance_viewport, "pause")
        statuses = live.statuses_of(context.scene, context.view_layer)
        if not statuses:
            self.layout.label(text="No viewport in rendered shading", icon="INFO")
        # Viewports that share a solver say the same.
        for warning in dict.fromkeys(text for status in statuses for text in status.warnings):
            draw_message(layout, context, warning, "INFO")


CLASSES = (RENDER_PT_antiradiance_viewport,)
