# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets of the engine's settings: the core's own and, through Blender, those that artists save."""
import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel

from . import core

# id -> what the core says of it
PRESETS = {preset["id"]: preset for preset in (core.native.presets() if core.native else ())}


class ANTIRADIANCE_OT_apply_preset(bpy.types.Operator):
    """Set all settings of the engine but Device and Report File"""
    bl_idname = "antiradiance.apply_preset"
    bl_label = "Apply Preset"
    bl_options = {"REGISTER", "UNDO"}

    preset: bpy.props.EnumProperty(
        name="Preset", description="What to set the engine to",
        items=[(preset["id"], preset["label"], preset["tooltip"], number)
               for number, preset in enumerate(PRESETS.values())])

    @classmethod
    def description(cls, _context, properties):
        return PRESETS[properties.preset]["tooltip"]

    def execute(self, context):
        settings = context.scene.antiradiance
        for name, value in PRESETS[self.preset]["values"].items():
            setattr(settings, name, value)
        return {"FINISHED"}


class ANTIRADIANCE_OT_preset_add(AddPresetBase, bpy.types.Operator):
    """Save the engine's settings as a preset, or remove one"""
    bl_idname = "antiradiance.preset_add"
    bl_label = "Add Antiradiance Preset"
    preset_menu = "RENDER_PT_antiradiance_presets"
    preset_subdir = "antiradiance"
    preset_defines = ["settings = bpy.context.scene.antiradiance"]

    @property
    def preset_values(self):
        values = next(iter(PRESETS.values()))["values"]  # all presets set the same
        return [f"settings.{name}" for name in values]


class RENDER_PT_antiradiance_presets(PresetPanel, bpy.types.Panel):
    bl_label = "Antiradiance Presets"
    preset_subdir = ANTIRADIANCE_OT_preset_add.preset_subdir
    preset_operator = "script.execute_preset"
    preset_add_operator = ANTIRADIANCE_OT_preset_add.bl_idname

    def draw(self, context):
        layout = self.layout
        layout.emboss = "PULLDOWN_MENU"
        column = layout.column(align=True)
        for identifier, preset in PRESETS.items():
            apply = column.operator(ANTIRADIANCE_OT_apply_preset.bl_idname, text=preset["label"])
            apply.preset = identifier
        layout.separator()
        if bpy.utils.preset_paths(self.preset_subdir):
            super().draw(context)
        else:  # Blender would say that a folder is missing, which the first preset makes
            layout.operator_context = "INVOKE_DEFAULT"
            layout.operator(self.preset_add_operator, text="Save as Preset...", icon="ADD")


CLASSES = (ANTIRADIANCE_OT_apply_preset, ANTIRADIANCE_OT_preset_add,
           RENDER_PT_antiradiance_presets)
