# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures 9 to 11 of Mückl & Dachsbacher again, on the Japanese-style room.

usage: BLENDER_USER_SCRIPTS=build/blender blender -b --factory-startup --python-exit-code 1
       --addons antiradiance -P tests/bench/figures.py -- FOLDER [--size 400 300]

Writes FOLDER/figure_9.jpg and so on, each a row of the pictures below, in their order.
"""

import argparse
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
SCENE = ROOT / "blend_scenes" / "japanese_room.blend"
# Final shooting as the paper has it: every patch, with its antiradiance.
SHOOTING = {"display": "FINAL_SHOOTING", "shooting_visibility": "ANTIRADIANCE",
            "shooting_level": "LEAVES", "interleave": 1}
FIGURES = {
    "figure_9": [{"display": "PATCHES"}, {"display": "SPLATTING"}, SHOOTING],
    "figure_10": [{**SHOOTING, "shooting_level": "CUT", "interleave": n} for n in (4, 8, 16)],
    "figure_11": [SHOOTING, {**SHOOTING, "shooting_level": "PARENTS"}],
}


def render(options, file):
    scene = bpy.context.scene
    for name, value in options.items():
        setattr(scene.antiradiance, name, value)
    scene.render.filepath = str(file)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(file))
    pixels = np.array(image.pixels, np.float32).reshape(image.size[1], image.size[0], 4)
    bpy.data.images.remove(image)
    return pixels


def save_row(pictures, file):
    row = np.concatenate(pictures, axis=1)
    image = bpy.data.images.new("row", row.shape[1], row.shape[0])
    image.pixels.foreach_set(row.ravel())
    image.file_format = "JPEG"
    image.filepath_raw = str(file)
    image.save()


def main():
    parser = argparse.ArgumentParser(prog="figures.py")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--size", type=int, nargs=2, default=(400, 300))
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
    bpy.ops.wm.open_mainfile(filepath=str(SCENE))
    settings = bpy.context.scene.render
    settings.engine = "ANTIRADIANCE"
    settings.use_persistent_data = True  # solved once
    settings.resolution_x, settings.resolution_y = options.size
    settings.resolution_percentage = 100
    settings.image_settings.file_format = "PNG"
    options.folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        for name, row in FIGURES.items():
            pictures = [render(case, Path(folder) / f"{name}_{i}.png")
                        for i, case in enumerate(row)]
            save_row(pictures, options.folder / f"{name}.jpg")


main()
