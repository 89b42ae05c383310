# SPDX-License-Identifier: GPL-3.0-or-later
"""Registers everything, or what explains why the engine cannot run."""
import importlib
import sys

import bpy

MODULES = ("compat", "core", "colour", "nodes", "images", "materials", "lamps", "camera", "world",
           "blockers", "sync", "render_log", "sessions", "properties", "presets", "ui", "failures",
           "view_camera", "view_picture", "viewport_status", "inspection", "viewport",
           "viewport_pause", "live", "viewport_message", "viewport_panel", "engine", "difference",
           "walls", "blocker_operators", "blocker_evaluation", "blocker_panel", "blocker_overlay",
           "planar", "wall_junctions", "wall_planes", "propose_blockers", "patch_links", "swatches",
           "pick_patch", "patch_overlay", "inspection_panel")

for _name in MODULES:  # in this order also when Blender reloads its scripts
    _full = f"{__package__}.{_name}"
    if _full in sys.modules:
        importlib.reload(sys.modules[_full])
    else:
        importlib.import_module(_full)

from . import (  # noqa: E402
    blocker_evaluation,
    blocker_operators,
    blocker_overlay,
    blocker_panel,
    blockers,
    core,
    difference,
    engine,
    inspection,
    inspection_panel,
    live,
    patch_links,
    patch_overlay,
    pick_patch,
    presets,
    properties,
    propose_blockers,
    render_log,
    sessions,
    swatches,
    ui,
    viewport_message,
    viewport_panel,
    viewport_pause,
)

_registered = []  # classes, in the order of registering


CLASSES_WITH_CORE = (*presets.CLASSES, *ui.CLASSES, *difference.CLASSES, *blocker_operators.CLASSES,
                     *blocker_evaluation.CLASSES, *propose_blockers.CLASSES, *blocker_panel.CLASSES,
                     *viewport_panel.CLASSES, *pick_patch.CLASSES, *inspection_panel.CLASSES)


def register():
    classes = [*engine.CLASSES, *blockers.CLASSES, *viewport_pause.CLASSES]
    if core.native is not None:
        group = properties.make_group(core.native.options_schema())
        of_viewports = inspection.make_group(core.native.inspect_modes(), core.native.link_kinds())
        classes += [group, of_viewports, *CLASSES_WITH_CORE]
    else:
        classes += ui.CLASSES_WITHOUT_CORE
    for cls in classes:
        bpy.utils.register_class(cls)
        _registered.append(cls)
    blockers.register_properties()
    viewport_pause.register_properties()
    if core.native is not None:
        bpy.types.Scene.antiradiance = bpy.props.PointerProperty(type=group)
        difference.register_properties()
        blocker_panel.register_menus()
        blocker_overlay.register()
        inspection.register_properties(of_viewports)
        inspection_panel.register_menus()
        patch_links.register()
        patch_overlay.register()
    else:
        print(f"Antiradiance: {core.load_error}", file=sys.stderr)
    sessions.register()
    live.register()
    viewport_message.register()
    ui.borrow_panels(engine.AntiradianceEngine.bl_idname)


def unregister():
    ui.return_panels(engine.AntiradianceEngine.bl_idname)
    viewport_message.unregister()
    live.unregister()
    if hasattr(bpy.types.Scene, "antiradiance"):
        patch_overlay.unregister()
        patch_links.unregister()
        inspection_panel.unregister_menus()
        swatches.unregister()
        inspection.unregister_properties()
        blocker_overlay.unregister()
        blocker_panel.unregister_menus()
        difference.unregister_properties()
        del bpy.types.Scene.antiradiance
    viewport_pause.unregister_properties()
    blockers.unregister_properties()
    for cls in reversed(_registered):
        bpy.utils.unregister_class(cls)
    _registered.clear()
    sessions.unregister()
    render_log.clear()
