# SPDX-License-Identifier: GPL-3.0-or-later
"""Blocking planes in Blender: how they are made, marked, put into walls, listed and taken back."""

import numpy as np
import pytest
from pytest import approx

# Coordinates in objects of some metres, through matrices of 32 bits.
TOLERANCE = 1e-5

BLOCKER = {"blocker": True, "display": "WIRE", "rays": [False] * 6}
ORDINARY = {"blocker": False, "display": "TEXTURED", "rays": [True] * 6}


@pytest.fixture(scope="module")
def cases(in_blender, tmp_path_factory):
    return in_blender("blocker_cases.py", tmp_path_factory.mktemp("library"))


def state(case):
    return {key: case[key] for key in BLOCKER}


def close(array):
    return approx(np.array(array, float), abs=TOLERANCE)


@pytest.mark.parametrize("align, low, high", [
    ("WORLD", [-1, 0, 3], [3, 4, 3]),
    ("CURSOR", [-1, 2, 1], [3, 2, 5]),  # the cursor is turned by 90 degrees about X
    ("VIEW", [-1, 0, 3], [3, 4, 3]),    # there is no view
])
def test_added_plane(cases, align, low, high):
    case = cases["added"][align]
    corners = np.array(case["corners"])
    assert corners.shape == (4, 3) and case["polygons"] == 1
    assert corners.min(axis=0) == close(low) and corners.max(axis=0) == close(high)
    assert state(case) == BLOCKER
    assert case["selected"] == [case["name"]]


def test_edit_mode_is_refused_with_a_reason(cases):
    add, evaluate = cases["in_edit_mode"]
    assert "added in Object Mode" in add and "evaluated in Object Mode" in evaluate


def test_make_and_clear(cases):
    case = cases["marked"]
    assert "Select the mesh objects first" in case["nothing"]
    assert case["only_lamp"] == ["CANCELLED"] and case["both"] == ["FINISHED"]
    assert case["made"] == BLOCKER and case["cleared"] == ORDINARY


def test_what_cannot_be_a_plane_is_named(cases):
    linked, lamp = cases["problems"]["said"]
    assert "'Linked'" in linked and "plane.blend" in linked and "override" in linked
    assert "'Lamp'" in lamp and "only meshes" in lamp
    assert cases["problems"]["marked"] == ["Own"]


def test_undo_and_redo(cases):
    made, added = ["Wall"], ["Blocking Plane", "Wall"]
    assert cases["undone"] == [added, made, [], made, added]


def test_plane_in_a_wall_that_is_scaled_turned_and_mirrored(cases):
    for case in cases["wall_moved_anyhow"]:
        assert state(case) == BLOCKER and case["faces"] == 1
        assert case["low"] == close([-1, 0, -1]) and case["high"] == close([1, 0, 1])
        assert case["centre"] == close([0, 0, 0])
        assert case["flat"] < TOLERANCE, "the object's Z axis is the face's normal"
        assert case["scale"] == close([1, 1, 1])
        assert case["active"] == case["name"]


def test_a_wall_thicker_than_the_limit(cases):
    case = cases["thin_limit"]
    assert case["far"]["low"] == close([0, 0.6, 0]) and case["far"]["high"] == close([4, 0.6, 3])
    # 0.6 in the object, 0.3 m in the world.
    assert case["scaled"]["low"] == close([0, 0.3, 0]) and case["scaled"]["high"] == close([4, 0.3, 3])


def test_triangles_become_one_outline(cases):
    case = cases["triangulated_quad"]
    assert case["faces"] == 1 and len(case["corners"]) == 4
    assert case["low"] == close([0, 0.1, 0]) and case["high"] == close([4, 0.1, 3])


def test_a_window_stays_open(cases):
    case = cases["triangulated_with_window"]
    assert case["low"] == close([0, 0.1, 0]) and case["high"] == close([4, 0.1, 3])
    assert 0 < case["area"] == approx(case["front_area"], rel=1e-5)
    assert case["front_area"] < 0.9 * 4 * 3


def test_wall_of_two_objects(cases):
    for case in cases["two_shells"]:
        assert case["centre"] == close([0, 0, -0.2]), "half of 0.4 m behind the face"


def test_concave_face(cases):
    case = cases["concave_face"]
    assert case["high_y"] - case["low_y"] == approx(0.2, abs=TOLERANCE)
    middle = (case["low_y"] + case["high_y"]) / 2
    assert case["low"] == close([0, middle, 0]) and case["high"] == close([3, middle, 3])


def test_face_of_edit_mode(cases):
    """The mesh as it is being edited; afterwards the plane is there to be moved."""
    case = cases["face_in_edit_mode"]
    assert case["mode"] == "OBJECT" and case["name"] == "Blocking Plane"
    corners = np.array(case["corners"])
    assert corners.min(axis=0) == close([1, 0.1, 0]) and corners.max(axis=0) == close([5, 0.1, 3])


def test_without_a_face(cases):
    case = cases["no_face"]
    assert "'Wall': it has no active face" in case["none"]["error"]
    assert "'Flat': its active face has no area" in case["degenerate"]["error"]
    assert "'Vertices': it has no active face" in case["empty"]["error"]
    assert "Select the wall" in case["no_mesh"]
    assert "name" not in case["none"], "nothing is made"


def test_a_row_selects_its_plane(cases):
    case = cases["rows"]
    assert case["listed"] == ["First", "Second"]
    none, *clicked, in_edit_mode, excluded = case["rows"]
    assert none == -1
    assert clicked == ["First", ["First"], "Second", ["Second"]]
    assert in_edit_mode == "Second", "another object is being edited"
    assert excluded == "Second", "the view layer excludes the object"


def test_figures_of_the_list(cases):
    shown = cases["shown_figures"]
    before, rendered, evaluated = shown[:3], shown[3:6], shown[6:]
    switches = [["mute", None, "HIDE_OFF"], ["solo", None, "SOLO_OFF"]]
    part = [["name", True, "MESH_PLANE"], *switches]
    wrong = [["name", True, "ERROR"], *switches]
    no_part = [["name", False, "MESH_PLANE"], ["mute", None, "HIDE_ON"], ["solo", None, "SOLO_OFF"]]

    def plain(*texts):
        return [[text, False] for text in texts]

    assert before == [["Good", *plain(""), *part], ["Bad", *plain(""), *part],
                      ["Muted", *plain(""), *no_part]]
    # An object and its instance count together, another whose name only begins alike does not.
    assert rendered == [["Good", *plain("1.2k"), *part], ["Bad", *plain("57k"), *part],
                        ["Muted", *plain(""), *no_part]]
    assert evaluated == [
        ["Good", *plain("1.2k", "999", "2"), *part],
        ["Bad", *plain("57k", "2.0k"), ["6", True], *wrong],
        ["Muted", *plain("", "", ""), *no_part]]


def test_filter_of_the_list(cases):
    everything, named, others = cases["filtered"]
    assert everything == ["Wall north", "Wall south", "Door"]
    assert named == ["Wall north", "Wall south"] and others == ["Door"]


def test_menus(cases):
    assert cases["menus"]["ANTIRADIANCE"] == {
        "VIEW3D_MT_mesh_add": ["antiradiance.add_blocking_plane"],
        "VIEW3D_MT_object": ["antiradiance.make_blocker", "antiradiance.clear_blocker",
                             "antiradiance.blocking_plane_from_face"],
        "VIEW3D_MT_edit_mesh_faces": ["antiradiance.blocking_plane_from_face"]}
    assert not any(cases["menus"]["BLENDER_WORKBENCH"].values()), "other engines do not know them"


def test_evaluation(cases):
    case = cases["evaluated"]
    inside, in_the_open = case["evaluation"]["per_plane"]
    assert (inside["name"], in_the_open["name"]) == ("Inside", "Open")
    assert inside["links_cut"] > 0 == inside["wrongly_cut"]
    assert in_the_open["wrongly_cut"] > 0


def test_a_render_cuts_with_the_same_planes(cases):
    planes = cases["evaluated"]["rendered"]["per_plane"]
    assert [plane["name"] for plane in planes] == ["Inside", "Open"]
    assert all(plane["links_cut"] > 0 for plane in planes)


def test_words_for_an_evaluation(cases):
    case = cases["evaluated"]
    (totals, bad), (_, good), (_, idle) = case["texts"]
    assert f"{case['evaluation']['links_cut']:,} of {case['evaluation']['links']:,} links" in totals
    assert bad.startswith("No surface lies between") and bad.endswith("openings: Open")
    assert good.startswith("The planes take no light away")
    assert idle.startswith("No link is cut")


def test_a_scene_that_cannot_be_evaluated(cases):
    assert "Error: The scene has no faces to render" in cases["evaluated"]["error"]


def test_the_add_on_leaves_nothing_behind(cases):
    case = cases["add_on_off"]
    there = {"menus": 3, "object": True, "panel": True}
    gone = {"menus": 0, "object": False, "panel": False}
    assert case["on"] == case["on_again"] == there
    assert case["off"] == case["off_again"] == gone
    assert case["without_core"] == {"menus": 0, "object": True, "panel": False}
    assert case["kept"], "what was marked stays marked"
