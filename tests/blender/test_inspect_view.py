# SPDX-License-Identifier: GPL-3.0-or-later
"""Views of a solution in rendered viewports, and the links of a patch that is clicked on."""

import numpy as np
import pytest
from pytest import approx

COLOUR_OF_KIND = {"needed": "blue", "occluded": "yellow", "antiradiance": "red"}
STEP = 0.01  # of colours that count as different: more than half floats round


@pytest.fixture(scope="module")
def cases(in_window, tmp_path_factory):
    return in_window("inspect_view_cases.py", tmp_path_factory.mktemp("inspect"), timeout=600,
                     options=["--enable-event-simulate"])


@pytest.fixture(scope="module")
def open_room(cases):
    """View -> (h, w, 3) of the room without an occluder, whose visibility is EXPLICIT."""
    return {view: pixels[..., :3] for view, pixels in
            np.load(cases["views_of_open_room"]["file"]).items()}


def colours(pixels):
    return len(np.unique(np.round(pixels[..., :3] / STEP).reshape(-1, 3), axis=0))


def is_grey(pixels):
    return np.ptp(pixels, axis=2).max() == 0


def test_each_view_differs_from_the_picture(open_room):
    """In more than one in ten pixels: the floor fills two thirds of them, what is beside it none."""
    picture = open_room["OFF"]
    for view, pixels in open_room.items():
        if view != "back":
            differs = (np.abs(pixels - picture) > STEP).any(axis=2).mean()
            assert (differs > 0.1) == (view != "OFF"), view
    assert (open_room["back"] == picture).all(), "the picture is back"


def test_higher_levels_have_fewer_patches(open_room):
    finest, coarser = open_room["level 0"], open_room["level 3"]
    assert not is_grey(finest) and not is_grey(coarser)
    # Three levels up are up to 64 patches in one; outlines add a darker colour to each.
    assert colours(finest) > 10 * colours(coarser)


def test_light_of_one_direction(open_room):
    from_the_wall = open_room["from the wall"]
    assert is_grey(from_the_wall), "no antiradiance in EXPLICIT, so nothing below 0"
    assert from_the_wall.max() > 0.01
    assert open_room["upwards"].max() == 0, "nothing lies below what is seen from above"


def test_a_converged_solution_has_no_residual(open_room):
    red, green, blue = np.moveaxis(open_room["RESIDUAL"], 2, 0)
    assert green.max() == blue.max() == 0, "below 1e-4, where yellow begins"
    assert red.max() > 0


def test_explicit_does_not_differ_from_itself(open_room):
    difference = open_room["EXPLICIT_DIFFERENCE"]
    assert is_grey(difference)
    assert (difference.max(axis=2) > 0.9).mean() > 0.5, "white on the floor, seen from above"


def test_views_need_no_new_solution(cases):
    before, after = cases["views_of_open_room"]["solutions"]
    assert before == after > 0


def test_two_viewports_show_one_solution(cases):
    case = cases["beside_each_other"]
    pixels = np.load(case["file"])
    assert case["one solver"]
    before, after = case["solutions"]
    assert before == after > 0
    assert case["views"] == ["HIERARCHY", "EXPLICIT_DIFFERENCE"]
    # Saturated patches in one; in the other nearly white ones, but where IMPLICIT errs.
    saturation = {view: np.ptp(pixels[view][..., :3], axis=2).mean() for view in ("one", "other")}
    assert saturation["one"] > 0.2 > 0.05 > saturation["other"] > 0


def test_files_keep_the_settings_of_each_viewport(cases):
    """view, level and links_shown; a file was opened after they had been changed."""
    assert cases["beside_each_other"]["loaded"] == [["EXPLICIT_DIFFERENCE", 0, 300],
                                                    ["HIERARCHY", 1, 123]]


def test_the_patch_under_a_pixel_is_picked(cases):
    case = cases["picked_at"]
    for name, height in (("floor", 0), ("block", 0.5)):
        picked = case[name]
        assert picked["done"] == ["FINISHED"]
        assert picked["point"][:2] == approx(picked["expected"], abs=case["pixel"]), name
        assert picked["point"][2] == approx(height, abs=1e-5)
        assert picked["normal"] == approx([0, 0, 1])
    assert case["perspective"]["point"] == approx([0, 0, 0.5], abs=case["pixel"])


def test_why_nothing_is_picked(cases):
    case = cases["picked_at"]
    done, reason = case["too early"]
    assert done == ["CANCELLED"] and "wait for the viewport's first picture" in reason
    done, reason = case["beside"]
    assert done == ["CANCELLED"] and "No surface that light reaches" in reason
    assert case["kept"], "what had been picked before"


def test_a_click_picks_and_escape_does_not(cases):
    case = cases["clicked"]
    assert case["invoked"] == ["RUNNING_MODAL"]
    assert case["after Esc"] is None
    assert case["picked"]["point"][:2] == approx([-2, 1], abs=cases["picked_at"]["pixel"])
    assert case["shows links"]
    [reason] = case["elsewhere"]
    assert "no 3D viewport in rendered shading" in reason


def test_links_have_the_colours_of_their_kinds(cases):
    kinds_there = {"open": {"needed"}, "behind": {"needed", "occluded", "antiradiance"}}
    for name, kinds in kinds_there.items():
        case = cases["links_in_colours"][name]
        assert case["before"]["any"] == case["no overlays"]["any"] == 0
        for shown, drawing in ((kind, case[kind]) for kind in COLOUR_OF_KIND):
            for kind, colour in COLOUR_OF_KIND.items():
                is_there = kind == shown and kind in kinds
                assert (drawing[colour] > 50) == is_there, (name, shown, colour, drawing)
                assert is_there or drawing[colour] == 0, (name, shown, colour, drawing)
            assert drawing["any"] > 0, "the patch is marked"
        assert case["all"]["any"] > 2 * case["one"]["any"], "one link beside all"


def test_links_follow_the_solution(cases):
    """Picked; without the wall; the floor below its place; undone; undone once more."""
    case = cases["undone_and_loaded"]
    picked, without_wall, moved, back, again = case["links"]
    assert picked > without_wall > 0 and moved is None
    assert (back, again) == (without_wall, picked)
    drawn = case["lines"]
    assert drawn[0] == drawn[4] > drawn[1] == drawn[3] > 0 and drawn[2] == 0
    assert case["place after loading"] is None


def test_the_menu_has_a_legend_for_each_view(cases):
    """Any error while it draws fails in_window()."""
    legend = {view: len(swatches) - len(COLOUR_OF_KIND) for view, swatches in cases["menu"].items()}
    assert legend == {"OFF": 0, "HIERARCHY": 0, "INCOMING_BIN": 4, "RESIDUAL": 4,
                      "EXPLICIT_DIFFERENCE": 5}
