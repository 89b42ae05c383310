# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames per second of every display mode, as in section 6.2 of Mückl & Dachsbacher, as JSON.

usage: BLENDER_USER_SCRIPTS=build/blender blender -b --factory-startup --python-exit-code 1
       --addons antiradiance -P tests/bench/display_table.py -- RESULT.json
       [--scene japanese_room] [--size 800 600] [--small 200 150] [--device CPU] [--patience 60] [--only TEXT]

A frame is all that a moved camera asks for: the G-buffer with 16 samples a pixel and direct light by
shadow rays, and the display mode's indirect light. What takes more than a minute (`--patience`), by a first render
at the small size, is measured there and scaled by the number of pixels ("scaled": true). "cpu_seconds"
is the processor time of the render, which other programs on the machine disturb less.
"""

import argparse
import json
import sys
import time
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
# Frames a second on a GeForce GTX 465 at 800 x 600 (the paper's section 6.2).
PAPER = {
    "flat": 8.5, "splatting": 7.7,
    "leaves 1": 0.04, "leaves 4": 0.44, "leaves 8": 1.22, "leaves 16": 2.88,
    "parents 1": 0.14, "parents 4": 1.29, "parents 8": 2.99, "parents 16": 5.09,
}


def cases():
    """{name: options}; the first two have the same names as the paper's."""
    yield "flat", {"display": "PATCHES"}
    yield "splatting", {"display": "SPLATTING"}
    # Of antiradiance, as in the paper; and the cut, which is this engine's own, with shadow rays.
    for visibility, level, prefix in (("ANTIRADIANCE", "LEAVES", "leaves"),
                                      ("ANTIRADIANCE", "PARENTS", "parents"),
                                      ("ANTIRADIANCE", "CUT", "cut"),
                                      ("RAYS", "CUT", "cut, rays")):
        for n in (1, 4, 8, 16):
            yield f"{prefix} {n}", {
                "display": "FINAL_SHOOTING", "shooting_visibility": visibility,
                "shooting_level": level, "interleave": n}


def arguments():
    parser = argparse.ArgumentParser(prog="display_table.py")
    parser.add_argument("result", type=Path)
    parser.add_argument("--scene", default="japanese_room")
    parser.add_argument("--size", type=int, nargs=2, default=(800, 600))
    parser.add_argument("--small", type=int, nargs=2, default=(200, 150))
    parser.add_argument("--device", default="CPU", choices=("CPU", "OPENGL", "AUTO"))
    parser.add_argument("--patience", type=float, default=60, help="seconds a frame")
    parser.add_argument("--only", default="", help="cases whose names hold this")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:])


class Bench:
    def __init__(self, options):
        bpy.ops.wm.open_mainfile(filepath=str(ROOT / "blend_scenes" / f"{options.scene}.blend"))
        self.scene = bpy.context.scene
        self.report = options.result.with_suffix(".report.json")
        render = self.scene.render
        render.engine = "ANTIRADIANCE"
        render.use_persistent_data = True  # solved once
        render.resolution_percentage = 100
        self.scene.antiradiance.solver = options.device
        self.scene.antiradiance.report_path = str(self.report)
        self.seconds({"display": "PATCHES"}, (8, 6))  # solves

    def seconds(self, case, size):
        """By the clock and of the processor, of the display at that size, and the report."""
        for name, value in case.items():
            setattr(self.scene.antiradiance, name, value)
        self.scene.render.resolution_x, self.scene.render.resolution_y = size
        begin = time.process_time()
        bpy.ops.render.render()
        cpu_seconds = time.process_time() - begin
        report = json.loads(self.report.read_text())
        return report["timings_s"]["display"], cpu_seconds, report

    def row(self, name, case, size, small, patience):
        factor = size[0] * size[1] / (small[0] * small[1])
        seconds, cpu_seconds, report = self.seconds(case, small)
        scaled = seconds * factor > patience
        if scaled:
            seconds, cpu_seconds = seconds * factor, cpu_seconds * factor
        else:
            seconds, cpu_seconds, report = self.seconds(case, size)
        return {"seconds": round(seconds, 3), "cpu_seconds": round(cpu_seconds, 3),
                "fps": round(1 / seconds, 4), "scaled": scaled,
                "backend": report["display"]["backend"], "paper_fps": PAPER.get(name)}


def main():
    options = arguments()
    bench = Bench(options)
    result = {"scene": options.scene, "size": options.size, "cases": {}}
    for name, case in cases():
        if options.only in name:
            result["cases"][name] = bench.row(
                name, case, options.size, options.small, options.patience)
            print(name, result["cases"][name], flush=True)
    bench.report.unlink()
    options.result.write_text(json.dumps(result, indent=1))


main()
