# SPDX-License-Identifier: GPL-3.0-or-later
"""Cancels a render in each of its stages, as the Esc key does.

argument: the scene. Result: {STAGE: seconds from the cancellation until render() returned}.
"""

import pathlib
import sys
import time

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402

# Every stage takes longer than half a second with these.
SLOW = {"link_threshold": 0.008, "visibility_rays": 16, "iterations": 50, "solver": "CPU"}


DELAY = 0.15  # s after a stage's beginning


class Artist:
    """Stands in for Blender's test_break(), which is never true without a window."""

    def __init__(self):
        engine = recorder.addon("engine")
        artist, progress = self, engine.RenderJob._progress

        def watched(job, fraction, stage):
            artist.see(stage)
            progress(job, fraction, stage)

        engine.RenderJob._progress = watched
        engine.RenderJob._cancelled = lambda _job: artist.presses_escape()
        self.stages = []

    def render(self, stage):
        """Seconds that a cancellation in `stage` took; None: the render ended before."""
        self._stage, self._began, self._cancelled = stage, None, None
        bpy.ops.render.render()
        return None if self._cancelled is None else time.monotonic() - self._cancelled

    def see(self, stage):
        if stage not in self.stages:
            self.stages.append(stage)
        if stage == self._stage and self._began is None:
            self._began = time.monotonic()

    def presses_escape(self):
        now = time.monotonic()
        if self._began is not None and now > self._began + DELAY and self._cancelled is None:
            self._cancelled = now
        return self._cancelled is not None


bpy.ops.wm.open_mainfile(filepath=recorder.arguments()[0])
scene = bpy.context.scene
scene.render.engine = "ANTIRADIANCE"
artist = Artist()
artist.render(None)
for name, value in SLOW.items():
    setattr(scene.antiradiance, name, value)
recorder.finish({stage: artist.render(stage) for stage in artist.stages})
