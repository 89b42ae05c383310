# SPDX-License-Identifier: GPL-3.0-or-later
"""For scripts about the rendered viewport: small 3D views, what was drawn in them, and waiting for
their work. Sees every update and every drawing of the add-on from when it is imported.
"""

import json
import time
from dataclasses import dataclass, field

import bpy
import numpy as np
import recorder
import windowed

live, viewport_module = recorder.addon("live"), recorder.addon("viewport")

SECONDS = 60.0  # that any of the work here may take on a machine that does something else as well


@dataclass
class Seen:
    """Of one region."""

    updates: list = field(default_factory=list)   # seconds that each view_update() took
    drawings: list = field(default_factory=list)  # and each view_draw()
    pixels: np.ndarray = None  # (h, w, 4) f32, row 0 below, scene-linear: after the last drawing


_seen = {}  # pointer of the region ->


def seen(region) -> Seen:
    return _seen.setdefault(region.as_pointer(), Seen())


def _watch():
    viewport = viewport_module.Viewport
    update, draw = viewport.update, viewport.draw

    def timed_update(self, context, depsgraph):
        begin = time.perf_counter()
        update(self, context, depsgraph)
        seen(context.region).updates.append(time.perf_counter() - begin)

    def timed_draw(self, engine, context, depsgraph):
        begin = time.perf_counter()
        draw(self, engine, context, depsgraph)
        of_region = seen(context.region)
        of_region.drawings.append(time.perf_counter() - begin)
        of_region.pixels = windowed.read_pixels()

    viewport.update, viewport.draw = timed_update, timed_draw


_watch()


def views():
    """(space, region) of each 3D view on the screen, the smallest first."""
    areas = [area for area in bpy.context.window_manager.windows[0].screen.areas
             if area.type == "VIEW_3D"]
    return [(area.spaces.active, next(r for r in area.regions if r.type == "WINDOW"))
            for area in sorted(areas, key=lambda area: area.width * area.height)]


def in_view(region, **override):
    """The context of one of the views()."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if region in area.regions[:])
    return bpy.context.temp_override(window=window, area=area, region=region, **override)


def split(region, direction, share):
    with in_view(region):
        bpy.ops.screen.area_split(direction=direction, factor=share)


def small_views(count=1):
    """Steps to the smallest `count` 3D views, some 170 x 120 pixels each, of as many as that takes:
    [(space, region)] in solid shading."""
    while len(views()) < 1 + count:
        split(views()[-1][1], "VERTICAL", 0.2)
        yield
        split(views()[0][1], "HORIZONTAL", 0.8)
        yield
    for space, _region in views():
        space.shading.type = "SOLID"
        space.show_region_header = space.show_region_toolbar = False
    yield
    return views()[:count]


def viewport(region):
    """What the add-on has behind a region, or None."""
    return live.viewport_at(region)


def solver_state(region):
    return viewport(region).solver.state()


def report(region):
    """Of the newest solution."""
    return json.loads(solver_state(region)["report"])


def is_final(region):
    """a final picture of the newest solution is drawn"""
    behind = viewport(region)
    if behind is None or behind.solver is None or behind.picture is None:
        return False
    solver, view = behind.solver.state(), behind.view.state()
    return (not solver["working"] and not view["making"] and behind.picture.quality == "FINAL"
            and behind.picture.solution == solver["solutions"])


def final(*regions):
    """Steps until all of the regions show their final pictures."""
    for region in regions:
        yield from windowed.until(described(is_final, region), SECONDS,
                                  tell=lambda region=region: situation(region))


def situation(region):
    behind = viewport(region)
    if behind is None or behind.solver is None:
        return f"viewport: {behind and behind.status}"
    state = {**solver_state(region), "report": "..."}
    return f"{state}, {behind.view.state()}, picture: {behind.picture and vars(behind.picture)}"


def updated(region, edit):
    """Steps until the add-on has been told of what edit() does to the scene."""
    before = len(seen(region).updates)
    edit()
    yield from windowed.until(described(is_told, region, before), SECONDS)


def is_told(region, before):
    """Blender tells the engine of an edit"""
    return len(seen(region).updates) > before


def solved_anew(region, edit):
    """Steps until the final picture of what edit() makes of the scene is drawn."""
    before = solver_state(region)["edits"]
    edit()
    yield from windowed.until(described(is_edited, region, before), SECONDS)
    yield from final(region)


def is_edited(region, before):
    """the solver has an edit"""
    return solver_state(region)["edits"] > before


def described(function, *arguments):
    def condition():
        return function(*arguments)

    condition.__doc__ = function.__doc__
    return condition


def lit_room():
    """A floor and a block under a point lamp in the dark, quick to solve, and nothing else."""
    scene = recorder.empty_scene()
    scene.world = None
    scene.render.engine = "ANTIRADIANCE"
    scene.antiradiance.link_threshold = 0.1
    recorder.quad("Floor", scale=(4, 4, 1)).data.materials.append(
        recorder.material("Floor", albedo=(0.6,) * 3))
    recorder.cube("Block", size=1.0, location=(0, 0, 0.5)).data.materials.append(
        recorder.material("Block", albedo=(0.3, 0.5, 0.7)))
    lamp = bpy.data.lights.new("Lamp", "POINT")
    lamp.energy = 100.0
    recorder.link(lamp, "Lamp", location=(1, -1, 3))
    return scene
