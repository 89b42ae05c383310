# SPDX-License-Identifier: GPL-3.0-or-later
"""Rendered viewports that end, or whose scene changes under them, while their solver works.

Result: {CASE: what its steps returned}. "left": {"viewports", "solvers", "timer", "pictures"} that
the add-on still has.
"""

import gc
import os
import pathlib
import sys
import weakref

import addon_utils
import bpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import live_view  # noqa: E402
import recorder  # noqa: E402
import windowed  # noqa: E402

PACKAGE = recorder.addon("core").__package__
CYCLES, WARM_UP = 50, 3  # of rendered and solid shading

pictures = weakref.WeakSet()  # every ViewPicture, which alone holds its GPUTexture


def watch_pictures():
    picture_class = recorder.addon("view_picture").ViewPicture
    make = picture_class.__init__

    def watched(self, picture):
        make(self, picture)
        pictures.add(self)

    picture_class.__init__ = watched


def left():
    gc.collect()
    live = live_view.live
    return {"viewports": len(live._viewports), "solvers": len(live._solvers._solvers),
            "timer": bpy.app.timers.is_registered(live._tick), "pictures": len(pictures)}


def threads():
    """Number of this process's, the core's included."""
    return len(os.listdir("/proc/self/task"))


def nothing_left():
    """viewports and solvers of the add-on end"""
    return not live_view.live._viewports and not live_view.live._solvers._solvers


def working_view():
    """Steps to a rendered view whose solver works on a finely linked room."""
    scene = live_view.lit_room()
    scene.antiradiance.max_patch_size = 0.02
    yield
    [(space, region)] = yield from live_view.small_views()
    space.shading.type = "RENDERED"
    yield from windowed.until(live_view.described(is_working, region))
    return scene, space, region


def is_working(region):
    """the solver of a viewport works"""
    behind = live_view.viewport(region)
    return behind is not None and behind.solver is not None and behind.solver.state()["working"]


def ended_by(end):
    """Steps to what is left after end(scene, space, region) while there is work."""
    scene, space, region = yield from working_view()
    end(scene, space, region)
    yield from windowed.until(nothing_left)
    yield from windowed.until(lambda: not bpy.app.timers.is_registered(live_view.live._tick))
    return left()


def shading():
    return ended_by(lambda scene, space, region: setattr(space.shading, "type", "SOLID"))


def engine():
    return ended_by(lambda scene, space, region: setattr(scene.render, "engine",
                                                         "BLENDER_WORKBENCH"))


def other_editor():
    def change(_scene, _space, region):
        with live_view.in_view(region):
            bpy.context.area.type = "TEXT_EDITOR"

    result = yield from ended_by(change)
    for area in bpy.context.window_manager.windows[0].screen.areas:
        if area.type == "TEXT_EDITOR":
            area.type = "VIEW_3D"
    yield
    return result


def closed_area():
    def close(_scene, _space, region):
        with live_view.in_view(region):
            bpy.ops.screen.area_close()

    return ended_by(close)


def new_file():
    return ended_by(lambda *_view: bpy.ops.wm.read_homefile(use_empty=True,
                                                            use_factory_startup=True))


def undone_and_redone():
    """The block is moved, deleted, and all of it undone and redone while there is work."""
    scene, _space, region = yield from working_view()
    scene.antiradiance.max_patch_size = 0.5

    def in_view(operator, **arguments):
        with live_view.in_view(region):
            operator(**arguments)

    in_view(bpy.ops.ed.undo_push, message="before")
    positions = []
    bpy.data.objects["Block"].location.x = 1.0
    in_view(bpy.ops.ed.undo_push, message="moved")
    yield
    bpy.data.objects.remove(bpy.data.objects["Block"])
    in_view(bpy.ops.ed.undo_push, message="deleted")
    for operator in (None, bpy.ops.ed.undo, bpy.ops.ed.undo, bpy.ops.ed.redo, bpy.ops.ed.redo):
        if operator is not None:
            yield from live_view.updated(region, lambda operator=operator: in_view(operator))
        yield from windowed.until(live_view.described(live_view.is_final, region),
                                  live_view.SECONDS)
        block = bpy.data.objects.get("Block")
        positions.append({"block": block and block.location.x,
                          "patches": live_view.report(region)["patches"],
                          "error": live_view.viewport(region).status.error})
    return positions


def disabled():
    """The add-on, with a view that works; enabled again, the view goes on."""
    scene, space, region = yield from working_view()
    before = threads()
    addon_utils.disable(PACKAGE)
    result = {"left": left(), "threads": threads() - before}
    yield
    addon_utils.enable(PACKAGE)
    scene.render.engine = "ANTIRADIANCE"
    scene.antiradiance.max_patch_size = 0.5
    space.shading.type = "RENDERED"
    yield from live_view.final(region)
    return result


def many_cycles():
    """Threads and pictures after a few cycles of rendered and solid shading, and after many."""
    live_view.lit_room()
    yield
    [(space, region)] = yield from live_view.small_views()
    space.region_3d.view_perspective = "PERSP"
    counts = []
    for cycle in range(WARM_UP + CYCLES):
        space.shading.type = "RENDERED"
        if cycle % 10 == 0:
            yield from live_view.final(region)
        else:
            yield from windowed.until(live_view.described(has_picture, region))
        space.shading.type = "SOLID"
        yield from windowed.until(nothing_left)
        if cycle in {WARM_UP - 1, WARM_UP + CYCLES - 1}:
            counts.append({"threads": threads(), **left()})
    return counts


def has_picture(region):
    """a viewport has a picture"""
    behind = live_view.viewport(region)
    return behind is not None and behind.picture is not None


CASES = (shading, engine, other_editor, closed_area, new_file, undone_and_redone, many_cycles,
         disabled)

windowed.drive_cases(CASES, redraw=False, begin=watch_pictures)
