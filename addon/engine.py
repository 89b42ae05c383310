# SPDX-License-Identifier: GPL-3.0-or-later
"""The render engine: Blender calls render() once a view layer and frame, view_update() after each
edit and view_draw() at each redraw of a 3D viewport in rendered shading."""
import time

import bpy
import numpy as np

from . import compat, core, failures, live, render_log, sessions
from .camera import frame_of, set_camera
from .properties import option_values
from .sync import SceneWriter, SyncCancelled

# One table for registering the passes and for writing them.
#   Blender's pass name: (view layer's switch, None = always; channels, their ids, socket type, key)
PASSES = {
    "Combined": (None, 4, "RGBA", "COLOR", "combined"),
    "Depth": ("use_pass_z", 1, "Z", "VALUE", "depth"),
    "Normal": ("use_pass_normal", 3, "XYZ", "VECTOR", "normal"),
}


class AntiradianceEngine(bpy.types.RenderEngine):
    bl_idname = "ANTIRADIANCE"
    bl_label = "Antiradiance"
    bl_use_preview = False  # materials are previewed by EEVEE
    bl_use_eevee_viewport = True
    bl_use_shading_nodes_custom = False

    # There is no __init__: Blender calls it once or twice depending on its version.
    _sessions = None  # (scene, view layer) -> the core's session

    def update_render_passes(self, scene, view_layer):
        for name, (switch, _channels, ids, kind, _key) in PASSES.items():
            if switch is None or getattr(view_layer, switch):
                self.register_pass(scene, view_layer, name, len(ids), ids, kind)

    def render(self, depsgraph):
        # An exception that leaves this method would count as success, with a black picture.
        try:
            self._render(depsgraph)
        except Exception as failure:
            self._fail(depsgraph, failure)

    def _render(self, depsgraph):
        if core.native is None:
            raise RuntimeError(core.load_error)
        scene = depsgraph.scene
        frame = frame_of(scene.render, self.resolution_x, self.resolution_y)
        job = RenderJob(self, depsgraph, frame)
        for view in self._views(scene):
            if view is not None:
                self.active_view_set(view)
            pictures = job.run()
            if pictures is None:
                return
            self._write(depsgraph.view_layer.name, view, frame, pictures)
        render_log.remember(scene.name, job.outcome)
        for warning in job.outcome.warnings:
            self.report({"WARNING"}, warning)

    def view_update(self, context, depsgraph):
        live.viewport_of(context.region).update(context, depsgraph)

    def view_draw(self, context, depsgraph):
        live.viewport_of(context.region).draw(self, context, depsgraph)

    @staticmethod
    def _views(scene):
        if not scene.render.use_multiview:
            return [None]
        return [view.name for view in scene.render.views if view.use]

    def _write(self, layer, view, frame, pictures):
        width, height = frame.size
        target = {} if view is None else {"view": view}
        result = self.begin_result(0, 0, width, height, layer=layer, **target)
        for render_pass in result.layers[0].passes:
            if render_pass.name in PASSES:
                key = PASSES[render_pass.name][-1]
                compat.write_pass(render_pass, np.ascontiguousarray(
                    pictures[key].reshape(height, width, render_pass.channels)))
        self.end_result(result)

    def session(self, depsgraph):
        if self._sessions is None:
            self._sessions = {}
        return sessions.session_of(self._sessions, depsgraph)

    def _fail(self, depsgraph, failure):
        message = failures.told(failure)
        render_log.remember(depsgraph.scene.name, render_log.Outcome(error=message))
        self.report({"ERROR"}, message)
        self.error_set(message)


class RenderJob:
    """Reads the scene and renders it; run() once a stereo view."""

    def __init__(self, engine, depsgraph, frame):
        self._engine = engine
        self._depsgraph = depsgraph
        self._frame = frame
        self._warnings = []
        self.outcome = render_log.Outcome()

    def run(self):
        """The core's result, or None if the artist cancelled."""
        options = option_values(self._depsgraph.scene.antiradiance)
        begin = time.perf_counter()
        self._warnings.clear()
        try:
            scene = self._read_scene()
        except SyncCancelled:
            return None
        except Exception as failure:
            self._report_failure(options, failure, time.perf_counter() - begin)
            raise
        result = self._engine.session(self._depsgraph).render(
            scene, options, progress=self._progress, cancelled=self._cancelled,
            sync_seconds=time.perf_counter() - begin,
            film_transparent=self._depsgraph.scene.render.film_transparent)
        if result["cancelled"]:
            return None
        self.outcome = render_log.of_success(result["report"], result["warnings"])
        return result

    def _read_scene(self):
        self._progress(0.0, "Reading the scene")
        scene = core.native.Scene()

        def warn(text):
            self._warnings.append(text)
            scene.add_warning(text)

        camera = self._engine.camera_override or self._depsgraph.scene.camera
        set_camera(scene, self._engine, self._depsgraph, camera, self._frame)
        SceneWriter(scene, warn).write(self._depsgraph, self._cancelled)
        return scene

    def _progress(self, fraction, stage):
        self._engine.update_stats("", stage)
        self._engine.update_progress(fraction)

    def _cancelled(self):
        return self._engine.test_break()

    def _report_failure(self, options, failure, seconds):
        path = options.get("report_path")
        if path:
            try:
                core.native.write_failure_report(path, str(failure), self._warnings, seconds)
            except core.native.SceneError as unwritable:
                # The failure itself matters more; it is reported by the caller.
                self._engine.report({"ERROR"}, str(unwritable))


CLASSES = (AntiradianceEngine,)
