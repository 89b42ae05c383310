# SPDX-License-Identifier: GPL-3.0-or-later
"""For scripts that drive a Blender with a window: steps between redraws, and what was drawn.

    def steps():
        with windowed.in_view():
            bpy.ops.some.operator("INVOKE_DEFAULT", True)  # True: with its undo step
        yield                                              # until the 3D view has been drawn
        return windowed.overlay()

    windowed.drive(steps)
"""

import os
import time
import traceback

import bpy
import gpu
import numpy as np
import recorder

INTERVAL = 0.02  # s between two looks at whether the view has been drawn

_drawn = {"times": 0, "pixels": None}


def in_view(**override):
    """The context of the 3D view; timers have none."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    return bpy.context.temp_override(window=window, area=area, region=region, **override)


def overlay():
    """(h, w, 4) float32, row 0 at the bottom: what lies over the scene in the view's last drawing."""
    return _drawn["pixels"]


def read_pixels():
    """(h, w, 4) float32, row 0 at the bottom: what has been drawn so far; in a draw handler only."""
    _left, _bottom, width, height = gpu.state.viewport_get()
    pixels = gpu.state.active_framebuffer_get().read_color(0, 0, width, height, 4, 0, "FLOAT")
    pixels.dimensions = width * height * 4
    return np.array(pixels, np.float32).reshape(height, width, 4)


def _after_drawing():
    _drawn["pixels"] = read_pixels()
    _drawn["times"] += 1


def until(condition, seconds=60.0, tell=lambda: ""):
    """Steps until `condition()` holds. Its docstring tells what did not come about; tell(): and how
    things are instead."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError(f"not in {seconds} s: {condition.__doc__ or condition} {tell()}")
        yield


def drive(steps, redraw=True):
    """Runs the generator function `steps` to its end; what it returns goes to recorder.finish().
    redraw: False: a step every INTERVAL, and the view is drawn when Blender or the add-on want."""
    bpy.context.preferences.view.show_splash = False
    bpy.types.SpaceView3D.draw_handler_add(_after_drawing, (), "WINDOW", "POST_PIXEL")
    generator = steps()
    waited_for = 0  # the number of drawings that there have to be

    def tick():
        nonlocal waited_for
        try:
            if not redraw:
                next(generator)
                return INTERVAL
            if _drawn["times"] >= waited_for:
                next(generator)
                # The drawing that is under way may have begun before the step.
                waited_for = _drawn["times"] + 2
            with in_view():
                bpy.context.area.tag_redraw()
            return INTERVAL
        except StopIteration as end:
            recorder.finish(end.value)
            code = 0
        except BaseException:
            traceback.print_exc()
            code = 1
        os._exit(code)  # quitting would ask to save, or crash in the graphics driver

    bpy.app.timers.register(tick, first_interval=INTERVAL, persistent=True)


def drive_cases(cases, redraw=True, begin=lambda: None):
    """drive() through generator functions, one after the other, once begin() was called; the result
    is {name of the case: what it returned}."""

    def steps():
        begin()
        yield
        results = {}
        for case in cases:
            results[case.__name__] = yield from case()
        return results

    drive(steps, redraw)
