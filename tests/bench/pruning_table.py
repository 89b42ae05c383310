# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables 1 and 2 and Figure 7 of Mückl & Dachsbacher again, with what pruning does to the light.

usage: BLENDER_USER_SCRIPTS=build/blender blender -b --factory-startup --python-exit-code 1
       --addons antiradiance -P tests/bench/pruning_table.py -- RESULT.json
       [--scenes office ELSEWHERE/soda_hall.blend ...] [--pictures FOLDER] [--percentage 100]

A scene is a name in blend_scenes/ or a .blend. Writes each scene's evaluation (the report's
"pruning") with the figures that the paper prints for its counterpart, and prints both as a Markdown
table. With --pictures also FOLDER/SCENE.png: a column each for EXPLICIT visibility and for IMPLICIT
with no pruning, with the paper's heuristics and with the conservative rule. Below the pictures the
engine's differences, four times as strong as they are and red where the picture is darker: first
against no pruning, then against EXPLICIT.
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
SCENES = ROOT / "blend_scenes"
ROOMS = ("cornell_box", "two_rooms", "office", "japanese_room", "desks", "corridor")

# What is not the default: about as many patches as the paper's model of the same floor has.
SETTINGS = {"soda_hall": {"link_threshold": 0.1, "max_patch_size": 1.7}}

LABELS = {"HEURISTIC_1": "heuristic 1", "HEURISTIC_2": "heuristic 2",
          "HEURISTIC_2_THEN_1": "2, then 1", "CONSERVATIVE": "conservative"}
EVALUATION = ("patches", "links", "explicit", "explicit_seconds", "unpruned", "evaluation")
COLUMNS = ("scene", "patches", "links", "rule", "blocked", "removed", "wrong (+)", "not removed",
           "seconds", "error", "bias", "leak")

# Tables 1 and 2, and section 6.1 for both rules, of which it prints the share that is wrong. A row
# holds what the rule removes when it tests for blocking with rays (this engine counts all blocked
# links), what the rule itself removes, what of that is wrong, what it leaves, and seconds.
ROW = ("explicit", "removed", "incorrect", "not_removed", "seconds")
PAPER = {
    "japanese_room": {"patches": 12745, "links": 629665, "rules": {
        "HEURISTIC_1": (157449, 129313, 54872, 83058, 22.1),
        "HEURISTIC_2": (71007, 34408, 11732, 48331, 26.0),
        "HEURISTIC_2_THEN_1": (None, 144983, round(0.455 * 144983), None, None)}},
    "office": {"patches": 14246, "links": 1470440, "rules": {
        "HEURISTIC_1": (581768, 395592, 124232, 310408, 248.2),
        "HEURISTIC_2": (260475, 85075, 28739, 204139, 224.9)}},
    "desks": {"patches": 14396, "links": 1465632, "rules": {
        "HEURISTIC_1": (759669, 280705, 7752, 486716, 80.5),
        "HEURISTIC_2": (690145, 300316, 11577, 401406, 127.0)}},
    "soda_hall": {"patches": 25023, "links": 2774452, "rules": {
        "HEURISTIC_1": (2076609, 1621749, 73998, 528858, 87.9),
        "HEURISTIC_2": (1888014, 1016923, 21026, 892117, 280.0),
        "HEURISTIC_2_THEN_1": (None, 1628987, round(0.047 * 1628987), None, None)}},
}

IMPLICIT = {"visibility": "IMPLICIT"}
PICTURES = {
    "EXPLICIT": {"visibility": "EXPLICIT", "pruning": "NONE"},
    "NONE": {**IMPLICIT, "pruning": "NONE"},
    "HEURISTIC_2_THEN_1": {**IMPLICIT, "pruning": "HEURISTIC_2_THEN_1"},
    "CONSERVATIVE": {**IMPLICIT, "pruning": "CONSERVATIVE"},
}
BASES = ("NONE", "EXPLICIT")  # what the differences are to


def arguments():
    parser = argparse.ArgumentParser(prog="pruning_table.py")
    parser.add_argument("result", type=Path)
    parser.add_argument("--scenes", nargs="+", default=ROOMS, metavar="NAME|FILE.blend")
    parser.add_argument("--pictures", type=Path, metavar="FOLDER")
    parser.add_argument("--percentage", type=int, default=100, help="of the scenes' resolution")
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])
    options.scenes = [scene_file(parser, scene) for scene in options.scenes]
    return options


def scene_file(parser, scene):
    path = Path(scene) if scene.endswith(".blend") else SCENES / f"{scene}.blend"
    if not path.is_file():
        parser.error(f"there is no {path}; scenes are {', '.join(ROOMS)} or a .blend file")
    return path.resolve()


def set_options(options):
    for name, value in options.items():
        setattr(bpy.context.scene.antiradiance, name, value)


def open_scene(path, percentage):
    bpy.ops.wm.open_mainfile(filepath=str(path))
    scene = bpy.context.scene
    scene.render.engine = "ANTIRADIANCE"
    scene.render.resolution_percentage = percentage
    scene.render.use_file_extension = False
    set_options(SETTINGS.get(path.stem, {}))
    return scene


def evaluate(path, folder):
    """What the report says of every rule; the picture that comes with it is tiny."""
    scene = open_scene(path, 100)
    scene.render.resolution_x = scene.render.resolution_y = 4
    report = folder / "report.json"
    set_options({**IMPLICIT, "pruning": "NONE", "evaluate_pruning": True, "display": "PATCHES",
                 "report_path": str(report)})
    bpy.ops.render.render()
    content = json.loads(report.read_text())
    return {"settings": SETTINGS.get(path.stem, {}),
            **{key: content["pruning"][key] for key in EVALUATION},
            "peak_memory_bytes": content["peak_memory_bytes"]}


# ------------------------------------------------------------------------------------- pictures


def pixels_of(image):
    """(h, w, 3), row 0 at the bottom."""
    pixels = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(image.size[1], image.size[0], -1)[..., :3]


def encoded(linear):
    """sRGB (IEC 61966-2-1) of 0..1"""
    return np.where(linear <= 0.0031308, 12.92 * linear,
                    1.055 * np.maximum(linear, 0.0031308) ** (1 / 2.4) - 0.055)


def render(scene, folder, name):
    """The image of the exact file, and the picture as it is shown."""
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = str(folder / f"{name}.exr")
    bpy.ops.render.render(write_still=True)
    settings.file_format, settings.color_depth = "PNG", "8"
    bpy.data.images["Render Result"].save_render(str(folder / f"{name}.png"), scene=scene)
    shown = bpy.data.images.load(str(folder / f"{name}.png"))
    return bpy.data.images.load(scene.render.filepath), pixels_of(shown)


def difference(scene, base):
    """Of the last render to an image: what is shown, and the relative RMS."""
    scene.antiradiance_comparison.image = base
    bpy.ops.render.antiradiance_difference()
    image = bpy.data.images["Antiradiance Difference"]
    return encoded(pixels_of(image)), image["relative_rms"]


def make_pictures(path, percentage, folder):
    """The rows of pictures one below the other, and {base: {picture: relative RMS}}."""
    scene = open_scene(path, percentage)
    scene.render.use_persistent_data = True  # one link mesh for all rules
    images, rows, figures = {}, {"": {}, **{base: {} for base in BASES}}, {}
    for name, options in PICTURES.items():
        set_options(options)
        images[name], rows[""][name] = render(scene, folder, name)
        for base in BASES:
            if base in images and base != name:
                rows[base][name], rms = difference(scene, images[base])
                figures.setdefault(base, {})[name] = rms
    # EXPLICIT comes before there is anything to be compared with.
    black = np.zeros_like(rows[""]["EXPLICIT"])
    return np.concatenate([np.concatenate([row.get(name, black) for name in PICTURES], axis=1)
                           for row in reversed(rows.values())]), figures


def save(pixels, path):
    image = bpy.data.images.new(path.stem, pixels.shape[1], pixels.shape[0])
    opaque = np.ones((*pixels.shape[:2], 1), np.float32)
    image.pixels.foreach_set(np.concatenate([pixels, opaque], axis=2).ravel().astype(np.float32))
    image.file_format = "PNG"
    image.filepath_raw = str(path)
    image.save()


# ---------------------------------------------------------------------------------------- table


def count(value):
    return "" if value is None else f"{value:,}"


def counts(rule):
    wrong = count(rule["incorrect"])
    if "incorrect_radiance" in rule:
        wrong += f" ({count(rule['incorrect_radiance'])})"
    seconds = "" if rule["seconds"] is None else f"{rule['seconds']:.1f}"
    return [count(rule["explicit"]), count(rule["removed"]), wrong, count(rule["not_removed"]),
            seconds]


def light(solution):
    return [f"{solution['relative_rms']:.3f}", f"{solution['bias']:+.3f}",
            f"{solution['largest_leak']:.2f}"]


def rows_of(name, table):
    yield [name, count(table["patches"]), count(table["links"]), "none", count(table["explicit"]),
           "", "", "", "", *light(table["unpruned"])]
    for rule, row in table["evaluation"].items():
        yield ["", "", "", LABELS.get(rule, rule), *counts(row), *light(row["solution"])]
    paper = table["paper"]
    for i, (rule, row) in enumerate(paper["rules"].items() if paper else ()):
        scene = ["the paper's", count(paper["patches"]), count(paper["links"])]
        yield [*(scene if i == 0 else [""] * 3), LABELS[rule], *counts(row), "", "", ""]


def markdown(tables):
    lines = [COLUMNS, ["---"] * len(COLUMNS)]
    for name, table in tables.items():
        lines += rows_of(name, table)
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def printed_in_the_paper(name):
    if name not in PAPER:
        return None
    rules = {rule: dict(zip(ROW, row)) for rule, row in PAPER[name]["rules"].items()}
    return {**PAPER[name], "rules": rules}


def write(tables, file):
    """As soon as there is something to write: what comes next may take long."""
    file.write_text(json.dumps(tables, indent=2) + "\n", encoding="utf-8")


def main():
    options = arguments()
    if options.pictures:
        options.pictures.mkdir(parents=True, exist_ok=True)
    tables = {}
    for path in options.scenes:
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary)
            table = tables[path.stem] = {**evaluate(path, folder),
                                         "paper": printed_in_the_paper(path.stem)}
            write(tables, options.result)
            if options.pictures:
                pixels, table["picture_relative_rms"] = make_pictures(
                    path, options.percentage, folder)
                save(pixels, options.pictures / f"{path.stem}.png")
                write(tables, options.result)
    print(markdown(tables))


main()
