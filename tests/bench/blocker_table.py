# SPDX-License-Identifier: GPL-3.0-or-later
"""What blocking planes do to rooms: links, light, time and memory, with and without them.

usage: BLENDER_USER_SCRIPTS=build/blender blender -b --factory-startup --python-exit-code 1
       --addons antiradiance -P tests/bench/blocker_table.py -- RESULT.json [--scenes NAME ...]

Each room is taken with the planes that the add-on proposes, "desks" also with two quads in its
parting walls, as the paper has them in Fig. 8. Of the links that IMPLICIT makes: how many the planes
cut, how many of those that 64 rays find occluded, and how many wrongly; the error of IMPLICIT's
solution against links tested with rays, before and after. Then renders of a tiny picture with each
way to visibility: links, bytes of the link mesh, seconds for links, visibility and solution.
Writes JSON and prints a Markdown table.
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "blender" / "inside"))
import recorder  # noqa: E402

core = recorder.addon("core")
propose_blockers = recorder.addon("propose_blockers")
option_values = recorder.addon("properties").option_values

ROOMS = ("two_rooms", "corridor", "desks", "office", "japanese_room")
# Corners of the middles of walls, in metres.
BY_HAND = {"desks": [[(x, 2.3, 0), (x, 6.4, 0), (x, 6.4, 2.9), (x, 2.3, 2.9)]
                     for x in (3.6 + 0.08, 2 * 3.6 + 0.16 + 0.08)]}


def arguments():
    parser = argparse.ArgumentParser(prog="blocker_table.py")
    parser.add_argument("result", type=Path)
    parser.add_argument("--scenes", nargs="+", default=ROOMS, choices=ROOMS)
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])


def open_room(name):
    bpy.ops.wm.open_mainfile(filepath=str(ROOT / "blend_scenes" / f"{name}.blend"))
    scene = bpy.context.scene
    scene.render.engine = "ANTIRADIANCE"
    scene.render.resolution_x = scene.render.resolution_y = 4
    scene.render.resolution_percentage = 100
    scene.antiradiance.display = "PATCHES"
    return scene


def add_by_hand(name):
    for corners in BY_HAND[name]:
        mesh = bpy.data.meshes.new("By hand")
        mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
        thing = bpy.data.objects.new("By hand", mesh)
        bpy.context.collection.objects.link(thing)
        thing.antiradiance.is_blocker = True


def add_proposed(_name):
    assert bpy.ops.antiradiance.propose_blocking_planes() == {"FINISHED"}


def evaluate(scene):
    native_scene = propose_blockers.read_scene(bpy.context.evaluated_depsgraph_get())
    return core.native.evaluate_blockers(native_scene, option_values(scene.antiradiance),
                                         all_links=True, light=True)


def render(scene, visibility, report):
    scene.antiradiance.visibility = visibility
    scene.antiradiance.report_path = str(report)
    bpy.ops.render.render()
    content = json.loads(report.read_text())
    seconds = {stage: round(content["timings_s"][stage], 3)
               for stage in ("links", "visibility", "solve")}
    return {"patches": content["patches"], "links": content["links"]["total"],
            "bytes": content["links"]["bytes"], "blockers": content["blockers"],
            "seconds": round(sum(seconds.values()), 3), "seconds_of": seconds}


def measure(name, add_planes, report):
    result = {}
    for which in ("without", "with"):
        scene = open_room(name)
        if which == "with":
            add_planes(name)
        result[which] = {visibility: render(scene, visibility, report)
                         for visibility in ("IMPLICIT", "EXPLICIT")}
    result["evaluation"] = evaluate(scene)
    return result


def percent(part, whole):
    return f"{100 * part / whole:.1f} %"


def row(label, result):
    found, ways = result["evaluation"], (result["without"], result["with"])
    cells = [label, str(len(found["per_plane"])), percent(found["links_cut"], found["links"]),
             percent(found["occluded_cut"], found["occluded"]),
             percent(found["occluded_radiance_cut"], found["occluded_radiance"]),
             f"{found['wrongly_cut']:,}",
             " -> ".join(f"{found[which]['relative_rms']:.3f}"
                         for which in ("without_planes", "with_planes"))]
    for visibility in ("IMPLICIT", "EXPLICIT"):
        cells.append(" -> ".join(f"{way[visibility]['links'] / 1e6:.2f} M" for way in ways) + ", "
                     + " -> ".join(f"{way[visibility]['bytes'] / 2**20:.0f}" for way in ways)
                     + " MiB, "
                     + " -> ".join(f"{way[visibility]['seconds']:.2f}" for way in ways) + " s")
    return "| " + " | ".join(cells) + " |"


def main():
    options = arguments()
    results, rows = {}, []
    with tempfile.TemporaryDirectory() as folder:
        for name in options.scenes:
            ways = {name: add_proposed}
            if name in BY_HAND:
                ways[f"{name}, by hand"] = add_by_hand
            for label, add_planes in ways.items():
                results[label] = measure(name, add_planes, Path(folder) / "report.json")
                rows.append(row(label, results[label]))
                options.result.write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")
    head = ("scene", "planes", "links cut", "of occluded", "of occluded +", "wrongly cut", "error",
            "IMPLICIT", "EXPLICIT")
    print("\n".join(["| " + " | ".join(head) + " |", "| --- " * len(head) + "|", *rows]))


main()
