# SPDX-License-Identifier: GPL-3.0-or-later
"""A camera flies through a room: this engine's time for all frames against Cycles' at equal error.

usage: BLENDER_USER_SCRIPTS=build/blender blender -b --factory-startup --python-exit-code 1
       --addons antiradiance -P tests/bench/fly_through.py -- RESULT.json
       [--frames 60] [--every 1] [--size 320 180] [--reference-samples 64] [--pictures FOLDER]

The engine renders every `every`-th frame in one job (EXPLICIT, FINAL_SHOOTING, CUT); the time of
all follows from the first frame's, which solves, and the others'. Cycles renders three of them
twice, with different seeds and `reference-samples` each: A and B. As their noise is independent,
    mean((picture - A) (picture - B)) is the picture's squared error without the references' noise,
    mean((A - B)^2) / 2 is Cycles' at that number of samples, and falls with 1 / samples.
So the samples at which Cycles' error equals the picture's follow, and, as its time goes with them,
the time of an animation. Errors are relative RMS as in tests/images/compare.py, over blocks of 1, 2
and 4 pixels squared: noise averages out over a block, the engine's error less so.

Times are by the clock, and of all cores together ("cpu"), which is what to go by on a busy machine.
"""

import argparse
import json
import sys
import tempfile
import time
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
SCENE = ROOT / "blend_scenes" / "office.blend"
sys.path.insert(0, str(ROOT / "tests" / "images"))
from compare import block_means, CLIP, read_rgb  # noqa: E402
from unbiased_cycles import set_up_cycles  # noqa: E402

BLOCKS = (1, 2, 4)  # pixels
COMPARED = 3  # frames
STEP = 0.001  # m, of the camera, for the flicker
# m: from the door past the desks to the shelves, at the height of the eyes, and what is looked at.
EYES = ((6.2, 0.7, 1.65), (4.6, 0.75, 1.55), (2.6, 0.7, 1.5), (1.0, 1.0, 1.55), (0.9, 1.9, 1.6))
TARGETS = ((2.8, 3.2, 1.0), (2.9, 3.4, 1.0), (3.0, 3.6, 1.0), (3.4, 3.6, 1.0), (4.6, 3.9, 1.0))


def arguments():
    parser = argparse.ArgumentParser(prog="fly_through.py")
    parser.add_argument("result", type=Path)
    parser.add_argument("--frames", type=int, default=60)
    parser.add_argument("--every", type=int, default=1, help="frames that are rendered")
    parser.add_argument("--size", type=int, nargs=2, default=(320, 180))
    parser.add_argument("--reference-samples", type=int, default=64)
    parser.add_argument("--pictures", type=Path, help="where the pictures stay")
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])
    if options.frames < COMPARED * options.every:
        parser.error(f"--every leaves fewer than {COMPARED} frames to compare")
    return options


def keyframe_path(thing, places, frames):
    for i, place in enumerate(places):
        thing.location = place
        thing.keyframe_insert("location", frame=1 + (frames - 1) * i / (len(places) - 1))


def add_flight(scene, frames):
    """A copy of the scene's camera on the path; Blender's curves smooth it."""
    camera, target = scene.camera.copy(), bpy.data.objects.new("Flight target", None)
    camera.data = scene.camera.data.copy()
    for thing, places in ((camera, EYES), (target, TARGETS)):
        scene.collection.objects.link(thing)
        keyframe_path(thing, places, frames)
    follow = camera.constraints.new("TRACK_TO")
    follow.target, follow.track_axis, follow.up_axis = target, "TRACK_NEGATIVE_Z", "UP_Y"
    scene.camera = camera


def add_step(scene, frame):
    """A camera that stands where the flight is in `frame`, and in its frame 2 STEP to the right."""
    scene.frame_set(frame)
    camera = bpy.data.objects.new("Step", scene.camera.data)
    camera.matrix_world = scene.camera.matrix_world.copy()
    scene.collection.objects.link(camera)
    right = camera.matrix_world.to_3x3().col[0]
    keyframe_path(camera, (camera.location, camera.location + STEP * right), 2)
    scene.camera = camera


def use_engine(scene):
    scene.render.engine = "ANTIRADIANCE"
    scene.antiradiance.visibility = "EXPLICIT"
    scene.antiradiance.display = "FINAL_SHOOTING"
    scene.antiradiance.shooting_level = "CUT"


class Clock:
    """Seconds by the clock and of all cores, when each frame of a job was written."""

    def __init__(self):
        self._begin = self._now()
        self.marks = []

    @staticmethod
    def _now():
        return np.array([time.monotonic(), time.process_time()])

    def mark(self, *_scene):
        self.marks.append(self._now() - self._begin)

    def seconds(self, frames, frame_scale=1.0):
        """(clock, cpu) of a job of `frames` frames that take `frame_scale` times as long, from what
        the marked ones took; the first one's preparations count once."""
        first = self.marks[0]
        if len(self.marks) == 1:
            return first * frames * frame_scale
        each = (self.marks[-1] - first) / (len(self.marks) - 1)
        preparations = np.maximum(first - each, 0)
        return preparations + each * frames * frame_scale


def render(scene, folder, name, frames):
    """Renders `frames` (evenly spaced) in one job. ([path of each], Clock)"""
    step = frames[1] - frames[0] if len(frames) > 1 else 1
    scene.frame_start, scene.frame_end, scene.frame_step = frames[0], frames[-1], step
    scene.render.filepath = str(folder / f"{name}_")
    clock = Clock()
    bpy.app.handlers.render_write.append(clock.mark)
    bpy.ops.render.render(animation=True)
    bpy.app.handlers.render_write.remove(clock.mark)
    return [folder / f"{name}_{frame:04}.exr" for frame in frames], clock


def render_cycles(scene, folder, name, frames, samples, seed):
    set_up_cycles(scene, samples, seed)
    scene.render.use_persistent_data = True  # as an artist would, for a flight
    paths, clock = render(scene, folder, name, frames)
    scene.render.use_persistent_data = False
    return paths, clock


def clipped(pictures, limit):
    return [np.minimum(read_rgb(path), limit) for path in pictures]


def errors(pictures, references_a, references_b):
    """{block: (error of the pictures, of Cycles at the references' samples)}, relative RMS"""
    references = [*references_a, *references_b]
    limit = CLIP * np.median([read_rgb(path) for path in references])
    mean = np.mean(clipped(references, limit))
    result = {}
    for block in BLOCKS:
        x, a, b = (np.array([block_means(p, block) for p in clipped(paths, limit)])
                   for paths in (pictures, references_a, references_b))
        own = max(0.0, np.mean((x - a) * (x - b)))
        cycles = np.mean((a - b) ** 2) / 2
        result[block] = np.sqrt(own) / mean, np.sqrt(cycles) / mean
    return result


def relative_change(first, second):
    """Relative RMS of the change from one picture to the other, pixel by pixel."""
    a, b = read_rgb(first), read_rgb(second)
    limit = CLIP * np.median(a)
    a, b = np.minimum(a, limit), np.minimum(b, limit)
    return float(np.sqrt(np.mean((a - b) ** 2)) / a.mean())


def flicker(scene, folder, frame, samples):
    """The change of the picture when the camera moves by STEP: of what is seen, and of noise.
    With another seed a frame, Cycles' falls with the root of its samples."""
    add_step(scene, frame)
    use_engine(scene)
    result = {"samples_of_cycles": samples,
              "antiradiance": relative_change(*render(scene, folder, "step", [1, 2])[0])}
    for animated in (False, True):
        name = "cycles_animated_seed" if animated else "cycles_fixed_seed"
        scene.cycles.use_animated_seed = animated
        paths, _ = render_cycles(scene, folder, name, [1, 2], samples, 0)
        result[name] = relative_change(*paths)
    return result


def equal_error_rows(options, all_errors, ours, cycles):
    """One row a block size. ours, cycles: Clocks."""
    own_time = ours.seconds(options.frames)
    for block, (own, theirs) in all_errors.items():
        ratio = (theirs / own) ** 2 if own > 0 else float("inf")
        time_of_cycles = cycles.seconds(options.frames, ratio)
        yield {
            "block": block,
            "error": own,
            "samples_of_cycles": options.reference_samples * ratio,
            "cycles_seconds": time_of_cycles[0], "cycles_cpu_seconds": time_of_cycles[1],
            "times_faster": time_of_cycles[0] / own_time[0],
            "times_faster_cpu": time_of_cycles[1] / own_time[1],
        }


def measure(options, folder):
    bpy.ops.wm.open_mainfile(filepath=str(SCENE))
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = options.size
    scene.render.resolution_percentage = 100
    scene.render.use_file_extension = True
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.antiradiance.report_path = str(folder / "report.json")
    add_flight(scene, options.frames)
    rendered = list(range(1, options.frames + 1, options.every))
    part = len(rendered) // COMPARED
    compared = rendered[part // 2 :: part][:COMPARED]

    use_engine(scene)
    pictures, ours = render(scene, folder, "ours", rendered)
    pictures = dict(zip(rendered, pictures))
    samples = options.reference_samples
    references_a, cycles = render_cycles(scene, folder, "a", compared, samples, 0)
    references_b, _ = render_cycles(scene, folder, "b", compared, samples, 1)
    all_errors = errors([pictures[frame] for frame in compared], references_a, references_b)
    seconds = ours.seconds(options.frames)
    return {
        "scene": SCENE.name, "blender": bpy.app.version_string,
        "frames": options.frames, "size": options.size,
        "rendered_frames": rendered, "compared_frames": compared,
        "seconds": seconds[0], "cpu_seconds": seconds[1],
        "stages_of_the_last_frame": json.loads((folder / "report.json").read_text())["stages"],
        "reference_samples": samples,
        "cycles_error_at_reference_samples": {block: e[1] for block, e in all_errors.items()},
        "equal_error": list(equal_error_rows(options, all_errors, ours, cycles)),
        "denoiser": None,  # Debian's Blender is built without one
        "flicker": flicker(scene, folder, compared[1], samples),
    }


def main():
    options = arguments()
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.pictures or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        text = json.dumps(measure(options, folder), indent=2)
    options.result.write_text(text + "\n", encoding="utf-8")
    print(text)


main()
