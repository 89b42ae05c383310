# SPDX-License-Identifier: GPL-3.0-or-later
"""build/bin/antiradiance from outside: report, picture, messages, exit codes."""

import csv
import importlib
import json
import signal
import subprocess
import time

import numpy as np
import OpenImageIO as oiio
import pytest

DONE, FAILED, WRONG_USAGE, CANCELLED = 0, 1, 2, 130
REPORT_KEYS = {
    "patches": None,
    "leaves": None,
    "links": {"radiance", "antiradiance", "total"},
    "solve": {"backend", "renderer", "iterations", "residual", "converged"},
    "display": {"mode", "backend", "renderer"},
    "timings_s": {"sync", "hierarchy", "links", "visibility", "direct", "solve", "display",
                  "total"},
    "pruning": {"method", "removed", "removed_radiance", "removed_antiradiance", "removed_dark",
                "seconds"},
    "visibility": {"mode", "rays", "explicit_rows", "implicit_rows"},
    "blockers": {"planes", "links_cut", "radiance_cut", "antiradiance_cut", "seconds",
                 "per_plane"},
    "stages": {"model", "pruning", "direct_light", "transport", "solve", "evaluation", "display"},
    "peak_memory_bytes": None,
    "warnings": None,
    "error": None,
}
MATERIALS = """
newmtl white
Kd 0.7 0.7 0.7
newmtl red
Kd 0.7 0.05 0.05
newmtl green
Kd 0.05 0.7 0.05
newmtl lamp
Kd 0 0 0
Ke 10 10 10
"""
# A unit room, to be seen from inside along -z, y up: red on the left, green on the right.
ROOM = """
mtllib room.mtl
v 0 0 0
v 1 0 0
v 1 0 1
v 0 0 1
v 0 1 0
v 1 1 0
v 1 1 1
v 0 1 1
v 0.3 0.99 0.3
v 0.7 0.99 0.3
v 0.7 0.99 0.7
v 0.3 0.99 0.7
o Room
usemtl white
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 3 4 8 7
usemtl red
f 4 1 5 8
usemtl green
f 2 3 7 6
o Lamp
usemtl lamp
f -4 -3 -2 -1
"""
VIEW = ["--camera-eye", "0.5", "0.5", "0.95", "--camera-target", "0.5", "0.5", "0",
        "--camera-fov", "100", "--resolution", "32", "24"]


@pytest.fixture(scope="session")
def binary(addon_folder):
    path = addon_folder.parents[2] / "bin" / "antiradiance"  # of the same build
    assert path.is_file(), f"{path} is missing: run packaging/build.sh first"
    return path


@pytest.fixture
def tool(binary):
    """tool("render", ...) -> CompletedProcess"""
    return lambda *arguments: subprocess.run(
        [binary, *map(str, arguments)], capture_output=True, text=True, timeout=120, check=False)


@pytest.fixture
def room(tmp_path):
    (tmp_path / "room.mtl").write_text(MATERIALS, encoding="utf-8")
    path = tmp_path / "room.obj"
    path.write_text(ROOM, encoding="utf-8")
    return path


def read_picture(path):
    """(h, w, 4) as in the file, row 0 above"""
    return oiio.ImageBuf(str(path)).get_pixels(oiio.FLOAT)


def relative_difference(a, b):
    return np.abs(a - b)[..., :3].mean() / b[..., :3].mean()


def test_report_on_standard_output(tool, room):
    result = tool("render", room)
    assert result.returncode == DONE, result.stderr
    report = json.loads(result.stdout)
    for key, inner in REPORT_KEYS.items():
        assert key in report
        assert inner is None or inner <= report[key].keys()
    assert report["error"] == "" and report["warnings"] == []
    assert report["solve"]["converged"]
    assert report["links"]["total"] == report["links"]["radiance"] > 1000
    assert report["timings_s"]["sync"] > 0
    assert result.stderr == "", "no progress where no terminal is"


def test_report_in_a_file(tool, room, tmp_path):
    path = tmp_path / "report.json"
    result = tool("render", room, "--report-path", path, "--visibility", "implicit")
    assert result.returncode == DONE and result.stdout == ""
    assert json.loads(path.read_text(encoding="utf-8"))["links"]["antiradiance"] > 1000


def test_picture_shows_what_the_camera_sees(tool, room, tmp_path):
    path = tmp_path / "room.exr"
    result = tool("render", room, "-o", path, *VIEW)
    assert result.returncode == DONE, result.stderr
    pixels = read_picture(path)
    assert pixels.shape == (24, 32, 4)
    assert (pixels[..., 3] == 1).all()
    left, right = pixels[8:16, :4].mean((0, 1)), pixels[8:16, -4:].mean((0, 1))
    assert left[0] > 3 * left[1] and right[1] > 3 * right[0]
    assert pixels[0, 10:22, :3].max() == pytest.approx(10), "the lamp is above"
    assert pixels[-1, 10:22, :3].max() < 10


def test_png_is_the_same_picture_in_srgb(tool, room, tmp_path):
    for name in ("room.exr", "room.png"):
        assert tool("render", room, "-o", tmp_path / name, *VIEW).returncode == DONE
    linear = np.clip(read_picture(tmp_path / "room.exr")[..., :3], 0, 1)
    encoded = np.where(linear > 0.0031308, 1.055 * linear ** (1 / 2.4) - 0.055, 12.92 * linear)
    assert read_picture(tmp_path / "room.png")[..., :3] == pytest.approx(encoded, abs=0.004)


def test_up_turns_the_picture_only(tool, room, tmp_path):
    for axis in "YZ":
        result = tool("render", room, "-o", tmp_path / f"{axis}.exr", "--up", axis,
                      "--camera-eye", ".9", ".5", ".5", "--camera-target", "0", ".5", ".5",
                      "--camera-fov", "90", "--resolution", "24", "24")
        assert result.returncode == DONE, result.stderr
    y_up, z_up = (read_picture(tmp_path / f"{axis}.exr") for axis in "YZ")
    # Seen along -x, +y above and +z on the left, or +z above and +y on the right.
    assert relative_difference(np.rot90(y_up, -1), z_up) < 0.1
    assert relative_difference(y_up, z_up) > 0.5


def test_scale_changes_no_radiance(tool, room, tmp_path):
    for scale in (1, 100):
        result = tool("render", room, "-o", tmp_path / f"{scale}.exr", *VIEW, "--scale", scale)
        assert result.returncode == DONE, result.stderr
    small, large = (read_picture(tmp_path / f"{scale}.exr") for scale in (1, 100))
    assert small == pytest.approx(large, rel=0.02, abs=0.02)


@pytest.fixture
def native_module(addon_folder, monkeypatch):
    monkeypatch.syspath_prepend(str(addon_folder))
    return importlib.import_module("_antiradiance")


def test_every_option_of_the_engine_has_a_flag(tool, native_module):
    schema = native_module.options_schema()
    text = tool("render", "--help").stdout
    for option in schema:
        assert "--" + option["name"].replace("_", "-") + " " in text


def test_preset(tool, room):
    """Flags change what it sets, wherever they stand."""
    for order in (0, 1):
        flags = [["--preset", "paper"], ["--iterations", "2", "--direct-light", "EXPLICIT"]]
        result = tool("render", room, *flags[order], *flags[1 - order])
        assert result.returncode == DONE, result.stderr
        report = json.loads(result.stdout)
        assert report["links"]["antiradiance"] > 1000
        assert report["pruning"]["method"] == "HEURISTIC_2_THEN_1"
        assert report["solve"]["iterations"] == 2


def test_presets_are_in_the_help(tool, native_module):
    text = tool("render", "--help").stdout
    presets = native_module.presets()
    assert [preset["id"] for preset in presets] == ["FINAL", "PREVIEW", "PAPER"]
    for preset in presets:
        assert preset["id"] + ": " in text


def test_unknown_preset(tool, room):
    result = tool("render", room, "--preset", "BEST")
    assert result.returncode == WRONG_USAGE
    for identifier in ("FINAL", "PREVIEW", "PAPER"):
        assert identifier in result.stderr


@pytest.mark.parametrize("arguments", [
    [],
    ["bake"],
    ["render"],
    ["render", "ROOM", "--visibilty", "EXPLICIT"],
    ["render", "ROOM", "--visibility", "SOMETIMES"],
    ["render", "ROOM", "--direction-bins", "7"],
    ["render", "ROOM", "--link-threshold", "much"],
    ["render", "ROOM", "--scale", "0"],
    ["render", "ROOM", "-o", "picture.jpg"],
    ["render", "ROOM", "--camera-eye", "0", "0", "1"],
    ["render", "ROOM", "--resolution", "0", "10"],
    ["difference"],
    ["difference", "a.exr"],
    ["difference", "a.exr", "b.exr", "-o", "c.jpg"],
])
def test_wrong_usage(tool, room, arguments):
    result = tool(*[room if argument == "ROOM" else argument for argument in arguments])
    assert result.returncode == WRONG_USAGE
    assert result.stderr != "" and result.stdout == ""


def test_heuristic_1_before_heuristic_2_is_refused(tool, room):
    result = tool("render", room, "--pruning", "heuristic_1_then_2")
    assert result.returncode == WRONG_USAGE
    assert "would see what blocks the others" in result.stderr


def test_help(tool):
    result = tool("render", "--help")
    assert result.returncode == DONE
    assert "OBJ files do not say" in result.stdout


def failure(result):
    assert result.returncode == FAILED, result
    assert result.stdout == ""
    return result.stderr


def test_picture_without_camera(tool, room, tmp_path):
    message = failure(tool("render", room, "-o", tmp_path / "a.png"))
    assert "A picture needs a camera" in message and "--camera-eye" in message
    assert not (tmp_path / "a.png").exists()


@pytest.mark.parametrize("content, part", [
    (None, "No such file or directory"),
    ("", "holds no faces"),
    ("\0\x01garbage\xff" * 1000, "holds no faces"),
    (ROOM.replace("v 1 1 0", "v 1 nan 0"), "line 8: 'v' needs 3 finite numbers"),
    (ROOM.replace("room.mtl", "gone.mtl"), "gone.mtl' can't be read"),
    (ROOM.replace("f 4 3 2 1", "f 4 3 2 100"), "Object 'Room': 1 face has corners"),
    ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "no faces"),
])
def test_bad_scene(tool, room, tmp_path, content, part):
    path = tmp_path / "bad.obj"
    if content is not None:
        path.write_text(content, encoding="utf-8", errors="surrogateescape")
    report = tmp_path / "report.json"
    message = failure(tool("render", path, "--report-path", report))
    assert part in message
    assert json.loads(report.read_text(encoding="utf-8"))["error"] in message


def test_unwritable_outputs(tool, room, tmp_path):
    gone = tmp_path / "no" / "folder"
    assert "No such file" in failure(tool("render", room, "-o", gone / "a.png", *VIEW))
    assert "report can't be written" in failure(
        tool("render", room, "--report-path", gone / "report.json"))


def test_all_problems_at_once(tool, room, tmp_path):
    (tmp_path / "room.mtl").write_text(MATERIALS + "map_Ke gone.png\n", encoding="utf-8")
    room.write_text(ROOM.replace("v 0 0 0", "v inf 0 0"), encoding="utf-8")
    message = failure(tool("render", room, "-o", tmp_path / "no" / "a.png"))
    for part in ("line 3: 'v'", "gone.png", "needs a camera", "picture can't be written"):
        assert part in message


@pytest.fixture
def picture(tmp_path):
    """picture(name, values) -> a linear .exr; values: (h, w, channels)"""

    def write(name, values):
        values = np.asarray(values, dtype=np.float32)
        height, width, channels = values.shape
        buffer = oiio.ImageBuf(oiio.ImageSpec(width, height, channels, oiio.FLOAT))
        buffer.set_pixels(oiio.ROI(), values)
        assert buffer.write(str(tmp_path / name)), buffer.geterror()
        return tmp_path / name

    return write


def test_difference(tool, picture, tmp_path):
    """Above: equal and darker; below: brighter, and brighter beyond the scale."""
    first = picture("first.exr", np.full((2, 2, 3), [0.2, 0.2, 0.2]))
    second = picture("second.exr", [[[0.2] * 3, [0.18] * 3], [[0.22] * 3, [0.9] * 3]])
    path = tmp_path / "difference.png"
    result = tool("difference", first, second, "-o", path)
    assert result.returncode == DONE, result.stderr

    def shown(linear):
        return 1.055 * linear ** (1 / 2.4) - 0.055

    less, more = 4 * (shown(0.2) - shown(0.18)), 4 * (shown(0.22) - shown(0.2))
    wanted = [[[0, 0, 0, 1], [less, 0, 0, 1]], [[0, more, 0, 1], [0, 1, 0, 1]]]
    assert read_picture(path) == pytest.approx(np.array(wanted), abs=0.5 / 255 + 1e-6)
    figures = json.loads(result.stdout)
    assert figures == pytest.approx({
        "mean_first": 0.2, "mean_second": 0.375, "largest": 0.7,
        "relative_rms": ((0.02**2 + 0.02**2 + 0.7**2) / 4) ** 0.5 / 0.2})


def test_difference_to_itself(tool, picture):
    path = picture("picture.exr", np.random.default_rng(1).random((3, 4, 4)))
    figures = json.loads(tool("difference", path, path).stdout)
    assert figures["relative_rms"] == figures["largest"] == 0
    assert figures["mean_first"] == figures["mean_second"] > 0


def test_difference_of_what_cannot_be_compared(tool, picture, tmp_path):
    small, large = picture("s.exr", np.ones((2, 3, 3))), picture("l.exr", np.ones((4, 3, 3)))
    deep = picture("deep.exr", np.ones((2, 3, 5)))
    gone, output = tmp_path / "gone.exr", tmp_path / "d.png"
    message = failure(tool("difference", small, large, "-o", output))
    assert "3 x 2" in message and "3 x 4" in message
    assert "gone.exr" in failure(tool("difference", small, gone, "-o", output))
    assert "5 channels" in failure(tool("difference", small, deep, "-o", output))
    assert not output.exists()
    unwritable = tmp_path / "no" / "d.png"
    assert "No such file" in failure(tool("difference", small, small, "-o", unwritable))


def test_interrupt_cancels(binary, room, tmp_path):
    report = tmp_path / "report.json"
    with subprocess.Popen(
            [binary, "render", room, "--max-patch-size", ".004", "--report-path", report],
            stderr=subprocess.PIPE, text=True) as process:
        time.sleep(1)
        assert process.poll() is None, "the scene is too small to interrupt"
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=20)
    assert process.returncode == CANCELLED and errors == "cancelled\n"
    assert json.loads(report.read_text(encoding="utf-8"))["error"] == "cancelled"


@pytest.fixture
def divided_room(room):
    """The room with a screen across it, as high as the room and nearly as wide."""
    with room.open("a", encoding="utf-8") as file:
        file.write("""o Screen
usemtl white
v 0.1 0 0.5
v 0.9 0 0.5
v 0.9 1 0.5
v 0.1 1 0.5
f -4 -3 -2 -1
""")
    return room


def evaluate(tool, scene, kind):
    result = tool("evaluate", scene, "--format", kind, "--max-patch-size", "0.5")
    assert result.returncode == DONE, result.stderr
    return result.stdout


def test_evaluate_pruning(tool, divided_room):
    """The three formats tell the same, and the columns of each rule add up."""
    table = json.loads(evaluate(tool, divided_room, "JSON"))
    assert {"HEURISTIC_1", "HEURISTIC_2", "HEURISTIC_2_THEN_1", "CONSERVATIVE"} <= set(
        table["evaluation"])
    assert table["evaluation"]["CONSERVATIVE"]["removed"] > 0
    for name, row in table["evaluation"].items():
        assert row["removed"] - row["incorrect"] == row["explicit"] - row["not_removed"], name
        assert row["explicit"] == table["explicit"] <= table["links"], name
        assert row["solution"]["converged"], name
    rows = list(csv.DictReader(evaluate(tool, divided_room, "CSV").splitlines()))
    assert [row["method"] for row in rows] == ["NONE", *table["evaluation"]]
    for row in rows[1:]:
        assert int(row["removed"]) == table["evaluation"][row["method"]]["removed"]
        assert int(row["links"]) == table["links"]
    text = evaluate(tool, divided_room, "TEXT").splitlines()
    assert [line.split()[0] for line in text] == ["method", "NONE", *table["evaluation"]]


def test_evaluate_needs_a_scene(tool, tmp_path):
    result = tool("evaluate", tmp_path / "missing.obj")
    assert result.returncode == FAILED
    assert "missing.obj" in result.stderr
