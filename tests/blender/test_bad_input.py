# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input ends in a message that names the object and says what to do; never in a black picture."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "images"))
from compare import read_rgb  # noqa: E402

# case -> words of its error: who it is, what is wrong, what to do.
ERRORS = {
    "no_geometry": ["no faces", "add a mesh"],
    "nan_coordinates": ["'Floor'", "NaN", "delete these vertices"],
    "infinite_coordinates": ["'Floor'", "infinite", "delete these vertices"],
    "flat_scale": ["'Line'", "scale is 0", "set every scale"],
    "missing_texture": ["'Floor'", "'Floor paint'", "no such picture.png", "Find Missing Files"],
    "several_at_once": ["'Broken'", "NaN", "'Painted'", "no such picture.png"],
    "too_many_patches": ["Max Patch Size", "'Floor'", "raise Max Patch Size"],
    "report_in_no_folder": ["no such folder", "check the folder"],
    "bug_in_the_addon": ["Internal error", "ZeroDivisionError"],
}

# Cases that render, with a warning.
WARNINGS = {
    "zero_area": ["'Floor'", "zero-area", "Degenerate Dissolve"],
    "duplicate_faces": ["'Floor'", "'Same floor'", "move or delete"],
    "bright_albedo": ["'Too bright'", "'Floor'", "make the colour darker"],
    "no_light": ["no light", "add a lamp"],
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("bad_input")


@pytest.fixture(scope="module")
def cases(in_blender, folder):
    return in_blender("error_cases.py", folder)


def test_every_case_is_judged(cases):
    assert set(cases) == set(ERRORS) | set(WARNINGS)


@pytest.mark.parametrize("name", ERRORS)
def test_error(cases, name):
    case = cases[name]
    assert not case["picture"]
    for words in ERRORS[name]:
        assert words in case["error"]
    if name == "report_in_no_folder":
        assert case["report"] is None
    else:
        assert case["report"]["error"]
        for words in ERRORS[name][:1] if name != "bug_in_the_addon" else ["a bug"]:
            assert words in case["report"]["error"]


@pytest.mark.parametrize("name", WARNINGS)
def test_warning(cases, name):
    case = cases[name]
    assert case["error"] == "" and case["picture"]
    warning, = (w for w in case["report"]["warnings"] if WARNINGS[name][-1] in w)
    for words in WARNINGS[name]:
        assert words in warning


def test_a_scene_without_light_is_black_and_others_are_not(cases, folder):
    for name in WARNINGS:
        assert (read_rgb(folder / f"{name}.exr").max() == 0) == (name == "no_light"), name


def test_exit_code(render):
    """On the command line a failed render is a failed command, and it leaves its report."""
    failed = render(ROOT / "blend_scenes" / "lamp_point.blend", python=(
        "for thing in list(scene.objects):\n"
        "    if thing.type == 'MESH':\n"
        "        bpy.data.objects.remove(thing)"))
    assert failed.exit_code == 1 and not failed.picture_files
    assert "no faces" in failed.log and "no faces" in failed.report["error"]
