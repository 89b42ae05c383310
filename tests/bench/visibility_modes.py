# SPDX-License-Identifier: GPL-3.0-or-later
"""IMPLICIT, MIXED, EXPLICIT and DISCRETE visibility against each other: error and time, as JSON.

usage: BLENDER_USER_SCRIPTS=build/blender blender -b --factory-startup --python-exit-code 1
       --addons antiradiance -P tests/bench/visibility_modes.py -- RESULT.json [--scenes office ...]

"error" is the relative RMS of the irradiance, direct and indirect, over all leaves (clipped at four
times the median), against EXPLICIT with 64 rays a link and the same link mesh. "seconds" is what a
render takes for links, visibility and solution; "rays" those between patches.
tests/bench/plot_visibility_modes.py draws the result.
"""

import argparse
import json
import sys
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "blender" / "inside"))
import visibility_ways  # noqa: E402

ROOMS = ("cornell_box", "two_rooms", "office", "japanese_room", "desks", "corridor")
WAYS = (
    {"IMPLICIT": {"visibility": "IMPLICIT"}, "DISCRETE": {"visibility": "DISCRETE"}}
    | {f"MIXED {budget}": {"visibility": "MIXED", "ray_budget": budget}
       for budget in (0.1, 0.25, 0.5, 0.75)}
    | {f"EXPLICIT {rays}": {"visibility": "EXPLICIT", "visibility_rays": rays}
       for rays in (1, 2, 4, 8, 16)}
)
TRUTH = {"reference_rays": 64, "normalised": True}


def arguments():
    parser = argparse.ArgumentParser(prog="visibility_modes.py")
    parser.add_argument("result", type=Path)
    parser.add_argument("--scenes", nargs="+", default=ROOMS, choices=ROOMS)
    parser.add_argument("--direct-light", default="EXPLICIT", choices=("EXPLICIT", "IMPLICIT"))
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])


def seconds_of(scene, way, report):
    """Of a render whose picture costs nothing worth mentioning."""
    for name, value in way.items():
        setattr(scene.antiradiance, name, value)
    bpy.ops.render.render()
    timings = json.loads(report.read_text(encoding="utf-8"))["timings_s"]
    return {stage: round(timings[stage], 3) for stage in ("links", "visibility", "solve")}


def measure(name, direct_light, report):
    path = str(ROOT / "blend_scenes" / f"{name}.blend")
    ways = [way | {"direct_light": direct_light} for way in WAYS.values()]
    errors = visibility_ways.compare(path, ways, TRUTH)
    bpy.ops.wm.open_mainfile(filepath=path)
    scene = bpy.context.scene
    scene.render.engine = "ANTIRADIANCE"
    scene.render.resolution_percentage = 5
    scene.antiradiance.display = "PATCHES"
    scene.antiradiance.report_path = str(report)
    result = {}
    for (label, way), error in zip(zip(WAYS, ways), errors):
        seconds = seconds_of(scene, way, report)
        result[label] = {"error": error["relative_rms"], "bias": error["bias"],
                         "rays": error["rays"], "links": error["links"],
                         "seconds": round(sum(seconds.values()), 3), "seconds_of": seconds}
        print(name, label, result[label], flush=True)
    return result


def main():
    options = arguments()
    report = options.result.with_suffix(".report.json")
    result = {}
    for name in options.scenes:
        result[name] = measure(name, options.direct_light, report)
        options.result.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    report.unlink()


main()
