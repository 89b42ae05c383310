# SPDX-License-Identifier: GPL-3.0-or-later
"""Final shooting's two ways to shadows on every room: error, grain and time against Cycles, as JSON.

usage: BLENDER_USER_SCRIPTS=build/blender blender -b --factory-startup --python-exit-code 1
       --addons antiradiance -P tests/bench/shooting_ways.py -- RESULT.json [--scenes office ...]

All of an EXPLICIT solution, which is made once for each way. "error" is the relative RMS of
tests/images/compare.py over blocks of 1, 2 and 4 pixels squared; "grain" what of it averages out
over 4 x 4 pixels, sqrt(error_1^2 - error_4^2), edges and the reference's own noise included, which
are the same for both. "seconds" and "cpu_seconds" are of a second picture, which solves nothing.
"""

import argparse
import json
import sys
import tempfile
import time
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "images"))
from compare import compare, read_rgb  # noqa: E402

ROOMS = ("cornell_box", "two_rooms", "office", "japanese_room", "desks", "corridor")
WAYS = ("RAYS", "ANTIRADIANCE")
BLOCKS = (1, 2, 4)


def arguments():
    parser = argparse.ArgumentParser(prog="shooting_ways.py")
    parser.add_argument("result", type=Path)
    parser.add_argument("--scenes", nargs="+", default=ROOMS, choices=ROOMS)
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])


def open_room(name, percentage, picture):
    bpy.ops.wm.open_mainfile(filepath=str(ROOT / "blend_scenes" / f"{name}.blend"))
    scene = bpy.context.scene
    render = scene.render
    render.engine = "ANTIRADIANCE"
    render.use_persistent_data = True  # solved once
    render.resolution_percentage = percentage
    render.filepath, render.use_file_extension = str(picture), False
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    scene.antiradiance.visibility = "EXPLICIT"
    scene.antiradiance.display = "FINAL_SHOOTING"
    return scene


def measure(scene, way, picture, reference):
    scene.antiradiance.shooting_visibility = way
    bpy.ops.render.render(write_still=True)
    clock, cpu = time.monotonic(), time.process_time()
    bpy.ops.render.render(write_still=True)
    seconds = {"seconds": time.monotonic() - clock, "cpu_seconds": time.process_time() - cpu}
    pixels = read_rgb(picture)
    error = {block: compare(pixels, reference, block).relative_rms for block in BLOCKS}
    grain = max(0.0, error[1] ** 2 - error[4] ** 2) ** 0.5
    return {"error": error, "grain": grain} | seconds


def main():
    options = arguments()
    references = json.loads((ROOT / "tests" / "images" / "references.json").read_text())
    result = {}
    with tempfile.TemporaryDirectory() as folder:
        picture = Path(folder) / "picture.exr"
        for name in options.scenes:
            scene = open_room(name, references[name]["percentage"], picture)
            reference = read_rgb(ROOT / "tests" / "images" / f"{name}.exr")
            result[name] = {way: measure(scene, way, picture, reference) for way in WAYS}
    text = json.dumps(result, indent=2)
    options.result.write_text(text + "\n", encoding="utf-8")
    print(text)


main()
