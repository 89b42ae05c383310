# SPDX-License-Identifier: GPL-3.0-or-later
"""Blocking planes as a Blender with a window draws them, and undo there."""

import pytest
from pytest import approx

# m: half the outline's width, and what a pixel covers.
RIM = 0.05


@pytest.fixture(scope="module")
def cases(in_window):
    return in_window("overlay_cases.py")


def seen_at(drawing, low, high):
    """Whether what was drawn has this extent on the ground."""
    return (drawing["pixels"] > 0 and drawing["low"] == approx(low, abs=RIM)
            and drawing["high"] == approx(high, abs=RIM))


def test_undo_and_redo(cases):
    added, undone, redone = cases["undone"]
    assert added["objects"] == redone["objects"] == ["Blocking Plane", "Cube"]
    assert seen_at(added["red"], [-1.5, -1.5], [1.5, 1.5]), "as large as the selected cube"
    assert undone["objects"] == ["Cube"]
    assert undone["red"]["pixels"] == undone["grey"]["pixels"] == 0
    assert redone["red"] == added["red"]


def test_undo_of_a_plane_from_a_face_in_edit_mode(cases):
    added, undone, mode, redone = cases["from_face_undone"]
    assert added == redone == ["Blocking Plane", "Wall"]
    assert undone == ["Wall"] and mode == "EDIT_MESH"


def test_size_of_a_new_plane(cases):
    of_nothing, of_selected, of_scene = cases["sizes_on_invoke"]
    assert of_nothing == approx(2.0)
    assert of_selected == approx(6.0, rel=1e-5), "a cube of 2 m, 3 times as long"
    assert of_scene == approx(20.0, rel=1e-5), "from -10 to 10 m; planes do not count"


def test_what_hides_a_plane(cases):
    assert len(cases["switched_off"]) == 8
    for way, (hidden, seen) in cases["switched_off"].items():
        assert hidden == 0 and seen > 10000, way


def test_planes_that_take_no_part_are_grey(cases):
    muted, solo = cases["parts"]["muted"], cases["parts"]["solo"]
    assert seen_at(muted["red"], [-2, -1], [3, 1]) and muted["grey"]["low"] == approx([-5, -1], abs=RIM)
    assert seen_at(solo["red"], [1, -1], [3, 1]) and solo["grey"]["low"] == approx([-5, -1], abs=RIM)
    assert solo["grey"]["pixels"] == approx(2 * solo["red"]["pixels"], rel=0.01)


def test_a_plane_out_of_sight_is_still_alone(cases):
    case = cases["solo_in_local_view"]
    assert case["red"]["pixels"] == 0 and seen_at(case["grey"], [-1, -1], [1, 1])


def test_panels(cases):
    """The headings have no name; any error while drawing fails in_window()."""
    assert set(cases["panels"]["RENDER"]) == {"", "Plane"}
    assert set(cases["panels"]["OBJECT"]) == {"Plane"}


def test_the_outline_has_the_colours_of_the_selection(cases):
    for channel, rim in enumerate(cases["outlines"]):  # red; then as the theme has it here
        others = [value for other, value in enumerate(rim[:3]) if other != channel]
        assert rim[channel] > 0.75 and max(others) < 0.25, rim


def test_evaluated_meshes(cases):
    case = cases["evaluated"]
    assert seen_at(case["modifier"], [-5, -1], [1, 1]), "two planes with a gap"
    assert seen_at(case["instance"], [1, 0], [3, 2])
    assert seen_at(case["two instances"], [-4.5, -0.5], [3.5, 0.5])
    assert case["hidden instance"]["pixels"] == 0
    assert seen_at(case["edited"], [-1, -1], [1, 1])
    assert case["bare"]["pixels"] == 0


def test_labels(cases):
    case = cases["labels"]
    assert case["without_text"]["pixels"] == 0
    shown = case["with_text"]
    assert shown["pixels"] > 100
    centre = [(low + high) / 2 for low, high in zip(shown["low"], shown["high"])]
    assert centre == approx([2, 1], abs=0.1), "at the plane with figures, and at no other"


def test_the_state_of_the_gpu_is_restored(cases):
    case = cases["gpu_state"]
    assert case["drawn"] > 0
    assert case["with"] == case["without"]
