# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender's render jobs keep of the solution, and what is left of it afterwards.

argument: a folder for pictures. Result: {CASE: {"reports": one JSON report a render of the engine,
in order; "left": number of the core's sessions that are still in memory after the job}}.
"""

import gc
import json
import pathlib
import sys
import weakref

import addon_utils
import bpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402
from recorder import cube, empty_scene, material, quad  # noqa: E402

FOLDER = pathlib.Path(recorder.arguments()[0])


class Watch:
    """Sees every session that is made and every report that a render hands out."""

    def __init__(self):
        self.sessions, self.reports = weakref.WeakSet(), []
        core, render_log = recorder.addon("core"), recorder.addon("render_log")
        make_session, of_success = core.native.Session, render_log.of_success

        def session():
            made = make_session()
            self.sessions.add(made)
            return made

        def outcome(report_json, warnings):
            self.reports.append(json.loads(report_json))
            return of_success(report_json, warnings)

        core.native.Session, render_log.of_success = session, outcome
        self._undo = lambda: setattr(core.native, "Session", make_session)

    def stop(self):
        self._undo()

    def take(self):
        gc.collect()
        reports, self.reports = self.reports, []
        return {"reports": reports, "left": len(self.sessions)}


def lit_room():
    scene = empty_scene()
    scene.render.engine = "ANTIRADIANCE"
    scene.render.resolution_x, scene.render.resolution_y = 16, 12
    scene.antiradiance.link_threshold = 0.1
    scene.frame_start, scene.frame_end = 1, 3
    scene.render.filepath = str(FOLDER / "frame_")
    quad("Floor", scale=(4, 4, 1)).data.materials.append(material("Floor", albedo=(0.6,) * 3))
    cube("Block", size=1.0, location=(0, 0, 0.5)).data.materials.append(
        material("Block", albedo=(0.3, 0.5, 0.7)))
    lamp = bpy.data.lights.new("Lamp", "POINT")
    lamp.energy = 100.0
    recorder.link(lamp, "Lamp", location=(1, -1, 3))
    return scene


def animate(thing, path, values):
    for frame, value in enumerate(values, start=1):
        setattr(thing, path, value)
        thing.keyframe_insert(path, frame=frame)


def move_camera(scene):
    animate(scene.camera, "location", [(0, -10, 1), (0.5, -10, 1), (1, -10, 1.5)])


def render_animation():
    bpy.ops.render.render(animation=True)


def camera_moves(watch):
    move_camera(lit_room())
    render_animation()
    return watch.take()


def block_moves(watch):
    move_camera(lit_room())
    animate(bpy.data.objects["Block"], "location", [(0, 0, 0.5), (0, 0, 0.5), (0.3, 0, 0.5)])
    render_animation()
    return watch.take()


def lamp_brightens(watch):
    lit_room()
    animate(bpy.data.lights["Lamp"], "energy", [100.0, 200.0, 200.0])
    render_animation()
    return watch.take()


def persistent_data(watch):
    """Two jobs; the second begins with what the first left."""
    scene = lit_room()
    move_camera(scene)
    scene.render.use_persistent_data = True
    render_animation()
    scene.frame_set(1)
    bpy.ops.render.render()
    return watch.take()


def other_engine(watch):
    """After persistent_data(): the setting is still on, and the artist changes the engine."""
    bpy.context.scene.render.engine = "BLENDER_WORKBENCH"
    return watch.take()


def view_layers(watch):
    """The block is in the second layer only; each layer keeps its own solution."""
    scene = lit_room()
    move_camera(scene)
    scene.frame_end = 2
    scene.view_layers[0].name = "Empty"
    collection = bpy.data.collections.new("Block")
    scene.collection.children.link(collection)
    block = bpy.data.objects["Block"]
    scene.collection.objects.unlink(block)
    collection.objects.link(block)
    scene.view_layers.new("Full")
    scene.view_layers["Empty"].layer_collection.children["Block"].exclude = True
    render_animation()
    return watch.take()


def two_scenes(watch):
    """One render each, in turns: between jobs nothing is kept."""
    first = lit_room()
    second = first.copy()
    for scene in (first, second, first):
        bpy.ops.render.render(scene=scene.name)
    return watch.take()


def failure(watch):
    """A job that fails in its second frame, and the job after it."""
    scene = lit_room()
    animate(bpy.data.objects["Block"], "scale", [(1, 1, 1), (0, 1, 1), (1, 1, 1)])
    try:
        render_animation()
    except RuntimeError:
        pass
    scene.frame_set(1)
    bpy.ops.render.render()
    return watch.take()


def add_on_off(watch):
    """Disabled with persistent data at hand, enabled again, rendered."""
    scene = lit_room()
    scene.render.use_persistent_data = True
    bpy.ops.render.render()
    package = recorder.addon("core").__package__
    watch.stop()
    addon_utils.disable(package)
    of_disabled = watch.take()
    handlers = [handler for event in ("render_init", "render_complete", "render_cancel")
                for handler in getattr(bpy.app.handlers, event)
                if handler.__module__.startswith(package)]
    addon_utils.enable(package)
    again = Watch()
    scene.render.engine = "ANTIRADIANCE"
    scene.render.use_persistent_data = False
    bpy.ops.render.render()
    result = again.take()
    return {"reports": of_disabled["reports"] + result["reports"],
            "left": of_disabled["left"] + result["left"], "handlers": len(handlers)}


CASES = (camera_moves, block_moves, lamp_brightens, persistent_data, other_engine, view_layers,
         two_scenes, failure, add_on_off)
watch = Watch()
recorder.finish({case.__name__: case(watch) for case in CASES})
