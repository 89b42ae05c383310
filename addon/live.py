# SPDX-License-Identifier: GPL-3.0-or-later
"""All 3D viewports in rendered shading and their solvers; one timer keeps both up to date.

Threads of the core never call Blender: the timer looks whether they have something new. It also
ends what no viewport shows any more; Blender does not say when it lets go of an engine.
"""
import bpy
from bpy.app.handlers import persistent

from . import core
from .images import ImageCache
from .ui import ENGINE
from .viewport import Viewport, settings_of

INTERVAL = 1 / 30  # s


class SolverPool:
    """The core's solvers. Viewports that show the same of the same view layer share one."""

    def __init__(self):
        self._solvers = {}  # (scene, view layer, viewport with a solver of its own or None) ->

    def solver(self, key):
        if key not in self._solvers:
            self._solvers[key] = core.native.LiveSolver()
        return self._solvers[key]

    def keep_only(self, keys):
        for key in self._solvers.keys() - keys:
            self._solvers.pop(key).stop()


_solvers = SolverPool()
_images = ImageCache()
_viewports: dict[int, Viewport] = {}  # pointer of the region ->
_listed = set()  # warnings, as panels have been told


def viewport_of(region) -> Viewport:
    """What is behind a region; made when it is asked for, and with it the timer."""
    key = region.as_pointer()
    if key not in _viewports:
        _viewports[key] = Viewport(key, _solvers, _images)
        if not bpy.app.timers.is_registered(_tick):
            bpy.app.timers.register(_tick, first_interval=INTERVAL)
    return _viewports[key]


def viewport_at(region) -> Viewport | None:
    return _viewports.get(region.as_pointer())


def statuses_of(scene, view_layer) -> list:
    """The Status of each viewport that shows the view layer."""
    shown = scene.name_full, view_layer.name
    return [viewport.status for viewport in _viewports.values()
            if viewport.solver_key is not None and viewport.solver_key[:2] == shown]


def rendered_regions():
    """(window, region) of all 3D viewports that this engine draws."""
    for window in bpy.context.window_manager.windows:
        if window.scene.render.engine != ENGINE:
            continue
        for area in window.screen.areas:
            if area.type == "VIEW_3D" and area.spaces.active.shading.type == "RENDERED":
                yield from ((window, region) for region in area.regions if region.type == "WINDOW")


def _tick():
    regions = {region.as_pointer(): (window.scene, region) for window, region in rendered_regions()}
    _keep_only(regions.keys())
    for key, viewport in _viewports.items():
        scene, region = regions[key]
        viewport.pause(scene.antiradiance_viewport.pause)
        if viewport.has_news():
            region.tag_redraw()
    for scene in {scene for scene, _region in regions.values()}:
        _note_settings(scene, [_viewports[key] for key, (shown, _) in regions.items()
                               if shown == scene and key in _viewports])
    _redraw_panels()
    return INTERVAL if _viewports else None


def _redraw_panels():
    """Those that list what viewports warn of, when that has changed."""
    global _listed
    warnings = {viewport.status.warnings for viewport in _viewports.values()}
    if warnings == _listed:
        return
    _listed = warnings
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "PROPERTIES":
                area.tag_redraw()


def _note_settings(scene, viewports):
    """Scripts and presets set properties of add-ons without a word to Blender's depsgraph."""
    if core.native is not None and any(viewport.posted_settings not in (None, settings_of(scene))
                                       for viewport in viewports):
        scene.update_tag()


def _keep_only(keys):
    for key in _viewports.keys() - keys:
        _viewports.pop(key).close()
    _solvers.keep_only({viewport.solver_key for viewport in _viewports.values()})
    if not _viewports:
        _images.clear()


@persistent
def stop(*_load_arguments):
    """All work for viewports ends; those that are still drawn begin again."""
    _keep_only(set())


def register():
    bpy.app.handlers.load_pre.append(stop)


def unregister():
    bpy.app.handlers.load_pre.remove(stop)
    if bpy.app.timers.is_registered(_tick):
        bpy.app.timers.unregister(_tick)
    stop()
