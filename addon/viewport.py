# SPDX-License-Identifier: GPL-3.0-or-later
"""One 3D viewport in rendered shading: what it posts to its solver, and what it shows.

Nothing of Blender's data is kept from one call to the next: undo makes all of it invalid.
"""
import time

from . import core, failures, inspection
from .properties import option_values
from .sync import SceneWriter
from .view_camera import camera_of
from .view_picture import ViewPicture
from .viewport_status import Status, status_of

# What a viewport does without: no file is written and nothing is measured after every edit.
NOT_IN_VIEWPORTS = {"report_path": "", "evaluate_pruning": False}
RENDERED_TYPES = {"MESH", "LIGHT"}  # of evaluated instances


def settings_of(scene) -> tuple[dict, bool]:
    """(the core's options, whether the film is transparent). scene: the original; an evaluated one
    takes over properties of add-ons only when told to."""
    return ({**option_values(scene.antiradiance), **NOT_IN_VIEWPORTS},
            scene.render.film_transparent)


class Viewport:
    """What is behind a region; live.py has the table of them."""

    def __init__(self, key: int, solvers, images):
        """key: of the region. solvers: the SolverPool that solvers come from. images: ImageCache"""
        self.key = key
        self.solver_key = None     # of its solver in the pool; None: it has posted nothing yet
        self.posted_settings = None
        self.status = Status()     # as last drawn
        self._solvers = solvers
        self._images = images
        self.solver = self.view = None
        self._newest = None        # of LiveView.picture(), not drawn yet
        self._number = 0           # of the newest picture
        self.picture = None        # the ViewPicture that is drawn
        self._failures = {}        # "update" or "draw" -> message of the exception that it ended in

    def update(self, context, depsgraph):
        """Posts the scene as this viewport shows it."""
        with self._failing("update"):
            self._post(context, depsgraph)

    def draw(self, engine, context, depsgraph):
        """The newest picture and the status line; the message of an error is drawn on top later."""
        if self.solver_key is None and "update" not in self._failures:
            self.update(context, depsgraph)
        if self.view is not None:
            with self._failing("draw"):
                self._draw(engine, context, depsgraph)
        self.status = self._present_status()
        engine.update_stats("", self._caption(context))

    def pause(self, paused: bool):
        if self.solver is not None:
            self.solver.pause(paused)

    def has_news(self) -> bool:
        """Whether drawing again would show something else."""
        self._fetch()
        return self._newest is not None or self._present_status() != self.status

    def close(self):
        if self.view is not None:
            self.view.stop()
        self.view = self.solver = self.picture = self._newest = self.solver_key = None

    def _failing(self, what):
        return failures.caught(self._failures, what)

    def _post(self, context, depsgraph):
        if core.native is None:
            raise RuntimeError(core.load_error)
        begin = time.perf_counter()
        scene = core.native.Scene()
        space, hidden = context.space_data, 0

        def shows(thing):
            nonlocal hidden
            visible = thing.visible_in_viewport_get(space)
            hidden += not visible and thing.type in RENDERED_TYPES
            return visible

        self._images.forget_edited(depsgraph.updates)
        writer = SceneWriter(scene, scene.add_warning, self._images.read_pixels)
        writer.write(depsgraph, shows=shows)
        # One that shows less than the view layer does has a solution of its own.
        self._use_solver((context.scene.name_full, depsgraph.view_layer.name,
                          self.key if hidden else None))
        self.solver.pause(context.scene.antiradiance_viewport.pause)
        self.posted_settings = settings_of(context.scene)
        options, film_transparent = self.posted_settings
        self.solver.post(scene, options, film_transparent=film_transparent,
                          sync_seconds=time.perf_counter() - begin)

    def _use_solver(self, key):
        if key == self.solver_key:
            return
        if self.view is not None:
            self.view.stop()
        self.solver = self._solvers.solver(key)
        self.view = core.native.LiveView(self.solver)
        self._newest, self._number = None, 0
        self.solver_key = key

    def _draw(self, engine, context, depsgraph):
        camera = camera_of(context, depsgraph)
        if camera is None:  # the border is out of sight
            return
        self.view.set_inspection(*inspection.arguments(context.space_data.shading))
        self.view.set_camera(camera.pop("matrix"), **camera)
        self._fetch()
        if self._newest is not None:
            self.picture, self._newest = ViewPicture(self._newest), None
        if self.picture is not None:
            self.picture.draw(engine, context.scene)

    def _fetch(self):
        newest = None if self.view is None else self.view.picture(self._number)
        if newest is not None:
            self._newest, self._number = newest, newest["number"]

    def _caption(self, context) -> str:
        if self.view is None:
            return self.status.line
        return inspection.captioned(self.status.line, context.space_data.shading)

    def _present_status(self) -> Status:
        if self._failures or self.view is None:
            return Status(error="\n".join(self._failures.values()))
        return status_of(self.solver.state(), self.view.state(),
                         "" if self.picture is None else self.picture.quality)
