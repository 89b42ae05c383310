# SPDX-License-Identifier: GPL-3.0-or-later
"""How soon the rendered viewport follows an edit and a moving camera, as JSON.

usage: BLENDER_USER_SCRIPTS=build/blender blender -b --factory-startup --python-exit-code 1
       --addons antiradiance -P tests/bench/viewport_table.py -- RESULT.json
       [--size 1280 720] [--visibility EXPLICIT] [--seconds 5]

Without a window: the add-on's own reading of the scene, and the core's solver and view behind a
viewport. Of each edit: "sync", which Blender waits for; "first", until any picture shows it;
"whole", until a picture of its whole solution; "final", until the picture that a render makes.
"navigation": pictures a second, and their share of the pixels, while the camera turns for some
seconds; alone and during a solution.
"""

import argparse
import json
import sys
import time
from pathlib import Path

import bpy
from antiradiance import core, sync
from antiradiance.camera import frame_of, set_camera
from antiradiance.properties import option_values
from mathutils import Matrix

ROOT = Path(__file__).resolve().parents[2]
TURN = 0.01  # rad from one camera to the next
POLL = 0.002  # s
CAMERA_INTERVAL = 1 / 60  # s


class NoStereo:
    """What set_camera() asks an engine."""

    def __init__(self, turn=0.0):
        self.turn = turn  # rad about the vertical

    def camera_shift_x(self, camera):
        return camera.data.shift_x

    def camera_model_matrix(self, camera):
        place = Matrix.Translation(camera.matrix_world.translation)
        return place @ Matrix.Rotation(self.turn, 4, "Z") @ place.inverted() @ camera.matrix_world


class Viewport:
    def __init__(self, size, visibility):
        self.size = size
        self.visibility = visibility
        self.solver = core.native.LiveSolver()
        self.view = core.native.LiveView(self.solver)
        self.seen = 0  # number of the newest picture

    def look(self, turn=0.0):
        depsgraph = bpy.context.evaluated_depsgraph_get()
        frame = frame_of(depsgraph.scene.render, *self.size)
        set_camera(self.view, NoStereo(turn), depsgraph, depsgraph.scene.camera, frame)

    def post(self):
        """Reads the scene as view_update() does; seconds that it took."""
        begin = time.perf_counter()
        depsgraph = bpy.context.evaluated_depsgraph_get()
        options = {**option_values(depsgraph.scene.antiradiance), "visibility": self.visibility}
        scene = core.native.Scene()
        sync.SceneWriter(scene, scene.add_warning).write(depsgraph)
        self.solver.post(scene, options)
        return time.perf_counter() - begin

    def follow(self, solutions, begin):
        """Seconds from `begin` to the pictures of an edit that there were so many solutions before."""
        times = {}
        while "final" not in times:
            picture = self.view.picture(self.seen)
            if picture is None:
                time.sleep(POLL)
                continue
            self.seen = picture["number"]
            if picture["solution"] <= solutions:
                continue
            now = round(time.perf_counter() - begin, 3)
            state = self.solver.state()
            if state["error"]:
                raise RuntimeError(state["error"])
            times.setdefault("first", now)
            if not state["working"] and picture["solution"] == state["solutions"]:
                times.setdefault("whole", now)
                if picture["quality"] == "FINAL":
                    times["final"] = now
        return times

    def after(self, edit):
        solutions = self.solver.state()["solutions"]
        edit()
        bpy.context.view_layer.update()
        begin = time.perf_counter()
        seconds = self.post()
        times = self.follow(solutions, begin)
        report = json.loads(self.solver.state()["report"])
        return {"sync": round(seconds, 4), **times,
                "stages": [name for name, what in report["stages"].items() if what == "run"],
                "timings_s": {name: round(s, 3) for name, s in report["timings_s"].items() if s}}

    def navigate(self, seconds):
        """Turns the camera about, sixty times a second."""
        pictures = self.view.state()["navigation_pictures"]
        pixels, count = 0, 0
        begin = time.perf_counter()
        turn = 0.0
        while time.perf_counter() - begin < seconds:
            turn += TURN
            self.look(turn)
            picture = self.view.picture(self.seen)
            if picture is not None:
                self.seen = picture["number"]
                height, width, _channels = picture["combined"].shape
                pixels, count = pixels + width * height, count + 1
            time.sleep(CAMERA_INTERVAL)
        elapsed = time.perf_counter() - begin
        return {"fps": round((self.view.state()["navigation_pictures"] - pictures) / elapsed, 1),
                "share_of_pixels": round(pixels / max(count, 1) / (self.size[0] * self.size[1]), 3)}


def arguments():
    parser = argparse.ArgumentParser(prog="viewport_table.py")
    parser.add_argument("result", type=Path)
    parser.add_argument("--size", type=int, nargs=2, default=(1280, 720))
    parser.add_argument("--visibility", default="EXPLICIT")
    parser.add_argument("--seconds", type=float, default=5, help="of navigation")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:])


def edits():
    """{name: function}, for the office: its luminaires are meshes."""
    def shader(material, kind):
        return next(node for node in bpy.data.materials[material].node_tree.nodes
                    if node.type == kind)

    strength = shader("Fluorescent light", "EMISSION").inputs["Strength"]
    wood = shader("Beech", "BSDF_DIFFUSE").inputs["Color"]
    desk = bpy.data.objects["Workplace 2 desk"]

    def brighten():
        strength.default_value *= 1.5

    def paint():
        wood.default_value = (0.6, 0.2, 0.1, 1.0)

    def move():
        desk.location.x += 0.1

    return {"lamp": brighten, "albedo": paint, "desk moved": move}


def main():
    options = arguments()
    bpy.ops.wm.open_mainfile(filepath=str(ROOT / "blend_scenes" / "office.blend"))
    viewport = Viewport(options.size, options.visibility)
    viewport.look()
    result = {"scene": "office", "size": options.size, "visibility": options.visibility,
              "edits": {"opened": viewport.after(lambda: None)}}
    for name, edit in edits().items():
        result["edits"][name] = viewport.after(edit)
    result["navigation"] = viewport.navigate(options.seconds)
    bpy.context.scene.antiradiance.max_patch_size = 0.1  # keeps the solver at work
    viewport.post()
    result["navigation during a solution"] = {
        **viewport.navigate(options.seconds), "still_solving": viewport.solver.state()["working"]}
    print(json.dumps(result, indent=1))
    options.result.write_text(json.dumps(result, indent=1) + "\n")


main()
