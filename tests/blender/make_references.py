# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the reference pictures of tests/images with Cycles on the CPU.

usage: nice -n 10 blender -b --factory-startup -P tests/blender/make_references.py -- [NAME...]
       [--samples N] [--percentage P]
Without names, every scene that blend_scenes/ holds.

Each scene is rendered twice with different seeds.  The reference is the mean of the two; their
difference measures its noise, with the metric of the tests (tests/images/compare.py).  How each
was made is kept in tests/images/references.json, from which the table of tests/images/README.md
is written; the image tests read the size of the picture there.
"""

import argparse
import json
import sys
import tempfile
import time
from pathlib import Path

import bpy
import numpy as np

REPOSITORY = Path(__file__).resolve().parents[2]
SCENES = REPOSITORY / "blend_scenes"
IMAGES = REPOSITORY / "tests" / "images"
RECORD = IMAGES / "references.json"
README = IMAGES / "README.md"
TABLE_START, TABLE_END = "<!-- table: start -->", "<!-- table: end -->"

# 400 x 300 scenes become 240 x 180 pictures, 60 x 45 blocks of the metric; or 160 x 120, 40 x 30
# blocks, where a picture takes long.
DEFAULT_PERCENTAGE = 60
PERCENTAGE = {"corridor": 40, "desks": 40, "japanese_room": 40, "modern_hall": 30, "office": 40,
              "two_rooms": 40}

# Samples of one of the two renders.  Chosen so that the noise of the mean stays about .01 or below.
DEFAULT_SAMPLES = 1024
SAMPLES = {"corridor": 400, "desks": 350, "japanese_room": 400, "office": 400, "two_rooms": 400}

sys.path.insert(0, str(IMAGES))
from compare import block_means, CLIP, DEFAULT_BLOCK, read_rgb  # noqa: E402
from unbiased_cycles import set_up_cycles  # noqa: E402


def write_settings(scene, path, depth):
    scene.render.filepath = str(path)
    scene.render.use_file_extension = False
    image = scene.render.image_settings
    image.file_format = "OPEN_EXR"
    image.color_mode = "RGB"
    image.color_depth = depth
    image.exr_codec = "ZIP"


def render(name, samples, seed, percentage, folder):
    """(height, width, 3) linear RGB of the scene and the seconds that the render took."""
    bpy.ops.wm.open_mainfile(filepath=str(SCENES / f"{name}.blend"))
    scene = bpy.context.scene
    set_up_cycles(scene, samples, seed)
    scene.render.resolution_percentage = percentage
    path = Path(folder) / f"{name}_{seed}.exr"
    write_settings(scene, path, "32")
    start = time.monotonic()
    bpy.ops.render.render(write_still=True)
    return read_rgb(path), time.monotonic() - start


def write_half(path, pixels):
    import OpenImageIO as oiio

    height, width, channels = pixels.shape
    spec = oiio.ImageSpec(width, height, channels, oiio.HALF)
    spec.attribute("compression", "zip")
    output = oiio.ImageOutput.create(str(path))
    data = np.ascontiguousarray(pixels, dtype=np.float32)
    if not (output and output.open(str(path), spec) and output.write_image(data)):
        raise OSError(f"{path}: {output.geterror() if output else oiio.geterror()}")
    output.close()


def noise_of_mean(a, b):
    """The standard error of (a + b) / 2 relative to its mean, clipped and on block means."""
    mean = 0.5 * (a + b)
    limit = CLIP * np.median(mean)
    a, b = (block_means(np.minimum(x, limit), DEFAULT_BLOCK) for x in (a, b))
    # Each of the two has variance rms(a - b)^2 / 2, and their mean half of that.
    return float(0.5 * np.sqrt(np.mean((a - b) ** 2)) / (0.5 * (a + b)).mean())


def make_reference(name, samples, percentage):
    with tempfile.TemporaryDirectory() as folder:
        (a, seconds_a), (b, seconds_b) = (
            render(name, samples, seed, percentage, folder) for seed in (0, 1)
        )
    path = IMAGES / f"{name}.exr"
    write_half(path, 0.5 * (a + b))
    return {
        "width": a.shape[1],
        "height": a.shape[0],
        "percentage": percentage,
        "samples": 2 * samples,
        "seconds": round(seconds_a + seconds_b),
        "noise": round(noise_of_mean(a, b), 5),
        "mean": round(float(0.5 * (a + b).mean()), 5),
        "blender": bpy.app.version_string,
    }


def write_table(record):
    rows = [
        "| picture | size | samples a pixel | seconds | noise of 4x4 block means | Blender |",
        "|---|---|---|---|---|---|",
    ]
    for name, made in sorted(record.items()):
        rows.append(
            f"| `{name}.exr` | {made['width']} x {made['height']} | {made['samples']} "
            f"| {made['seconds']} | {made['noise']:.4f} | {made['blender']} |"
        )
    text = README.read_text()
    before, rest = text.split(TABLE_START)
    after = rest.split(TABLE_END)[1]
    README.write_text(before + "\n".join([TABLE_START, *rows, TABLE_END]) + after)


def main():
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="make_references.py")
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--samples", type=int, help="of each of the two renders")
    parser.add_argument("--percentage", type=int, help="of the scene's resolution")
    options = parser.parse_args(arguments)
    present = sorted(path.stem for path in SCENES.glob("*.blend"))
    unknown = sorted(set(options.names) - set(present))
    if unknown:
        parser.error(f"no such scene: {', '.join(unknown)}; there are {', '.join(present)}")
    for name in options.names or present:
        samples = options.samples or SAMPLES.get(name, DEFAULT_SAMPLES)
        percentage = options.percentage or PERCENTAGE.get(name, DEFAULT_PERCENTAGE)
        made = make_reference(name, samples, percentage)
        print(f"{name}: {made}")
        record = json.loads(RECORD.read_text()) if RECORD.exists() else {}
        record[name] = made
        RECORD.write_text(json.dumps(record, indent=2, sort_keys=True) + "\n")
        write_table(record)


# Blender turns an exception in a -P script into exit code 0; a build step must see it fail.
try:
    main()
except Exception:
    import traceback

    traceback.print_exc()
    sys.exit(1)
