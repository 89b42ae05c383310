# SPDX-License-Identifier: GPL-3.0-or-later
"""Registers everything, or what explains why the engine cannot run."""
import importlib
import sys

import bpy

MODULES = ("compat", "core", "colour", "nodes", "images", "materials", "lamps", "camera", "world",
           "sync", "render_log", "sessions", "properties", "engine", "presets", "ui",
           "difference")

for _name in MODULES:  # in this order also when Blender reloads its scripts
    _full = f"{__package__}.{_name}"
    if _full in sys.modules:
        importlib.reload(sys.modules[_full])
    else:
        importlib.import_module(_full)

from . import (  # noqa: E402
    core,
    difference,
    engine,
    presets,
    properties,
    render_log,
    sessions,
    ui,
)

_registered = []  # classes, in the order of registering


def register():
    classes = []
    if core.native is not None:
        group = properties.make_group(core.native.options_schema())
        classes.append(group)
    classes += engine.CLASSES
    classes += ([*presets.CLASSES, *ui.CLASSES, *difference.CLASSES] if core.native
                else ui.CLASSES_WITHOUT_CORE)
    for cls in classes:
        bpy.utils.register_class(cls)
        _registered.append(cls)
    if core.native is not None:
        bpy.types.Scene.antiradiance = bpy.props.PointerProperty(type=group)
        difference.register_properties()
    else:
        print(f"Antiradiance: {core.load_error}", file=sys.stderr)
    sessions.register()
    ui.borrow_panels(engine.AntiradianceEngine.bl_idname)


def unregister():
    ui.return_panels(engine.AntiradianceEngine.bl_idname)
    if hasattr(bpy.types.Scene, "antiradiance"):
        difference.unregister_properties()
        del bpy.types.Scene.antiradiance
    for cls in reversed(_registered):
        bpy.utils.unregister_class(cls)
    _registered.clear()
    sessions.unregister()
    render_log.clear()
