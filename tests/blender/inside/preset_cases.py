# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets and the panels that show them.

arguments: SCENE.blend, a folder for reports. Result: {CASE: what it returns}; settings are
{name: value} of all that presets set.
"""

import pathlib
import sys
import types

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402

SCENE, FOLDER = map(pathlib.Path, recorder.arguments())
PRESETS = recorder.addon("presets").PRESETS


def settings():
    return bpy.context.scene.antiradiance


def values():
    return {name: getattr(settings(), name) for name in PRESETS["FINAL"]["values"]}


def open_scene():
    bpy.ops.wm.open_mainfile(filepath=str(SCENE))
    render = bpy.context.scene.render
    render.engine = "ANTIRADIANCE"
    render.resolution_x = render.resolution_y = 32
    render.resolution_percentage = 100


def applied():
    """Each preset after another, from settings that none of them has."""
    open_scene()
    settings().solver, settings().report_path = "CPU", "//report.json"
    result = {}
    for identifier, preset in PRESETS.items():
        settings().interleave, settings().evaluate_pruning = 3, True
        bpy.ops.antiradiance.apply_preset(preset=identifier)
        result[identifier] = {"wanted": preset["values"], "set": values(),
                              "kept": (settings().solver, settings().report_path)}
    return result


def paper_rendered():
    open_scene()
    report = FOLDER / "paper.json"
    settings().report_path = str(report)
    bpy.ops.antiradiance.apply_preset(preset="PAPER")
    settings().max_patch_size = 0.5
    bpy.ops.render.render()
    return report.read_text()


def undone():
    open_scene()
    settings().interleave = 3
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.antiradiance.apply_preset("EXEC_DEFAULT", True, preset="PAPER")
    after = values()
    bpy.ops.ed.undo()
    return {"after": after, "undone": values()}


def saved_by_an_artist():
    """Through Blender's own operators: save, change, load, remove."""
    open_scene()
    settings().solver, settings().direction_bins = "CPU", 96
    settings().visibility, settings().link_threshold = "IMPLICIT", 0.0625
    before = values()
    bpy.ops.antiradiance.preset_add(name="My Preset")
    bpy.ops.antiradiance.apply_preset(preset="FINAL")
    settings().solver = "OPENGL"
    subdir = bpy.types.RENDER_PT_antiradiance_presets.preset_subdir
    path = bpy.utils.preset_find("My_Preset", subdir)
    bpy.ops.script.execute_preset(filepath=path, menu_idname="RENDER_PT_antiradiance_presets")
    result = {"before": before, "loaded": values(), "solver": settings().solver}
    bpy.ops.antiradiance.preset_add(name="My Preset", remove_name=True)
    return {**result, "there": pathlib.Path(path).exists()}


class Layout:
    """Records what a panel draws: `shown` is {property: whether it is active}."""

    def __init__(self, shown):
        self.active, self._shown = True, shown

    def column(self, **_arguments):
        return Layout(self._shown)

    row = column

    def prop(self, _owner, name, **_arguments):
        self._shown[name] = self.active


def drawn(panel):
    shown = {}
    drawing = types.SimpleNamespace(layout=Layout(shown), options=panel.options)
    panel.draw(drawing, bpy.context)
    return shown


def greyed_out():
    """In the panels "Link Mesh" and "Display", by preset."""
    open_scene()
    result = {}
    for identifier in PRESETS:
        bpy.ops.antiradiance.apply_preset(preset=identifier)
        shown = {**drawn(bpy.types.RENDER_PT_antiradiance_link_mesh),
                 **drawn(bpy.types.RENDER_PT_antiradiance_display)}
        result[identifier] = [name for name, active in shown.items() if not active]
    return result


CASES = (applied, paper_rendered, undone, saved_by_an_artist, greyed_out)
recorder.finish({case.__name__: case() for case in CASES})
