# SPDX-License-Identifier: GPL-3.0-or-later
"""Rendered viewports side by side, their pause, and their errors."""

import pytest
from pytest import approx


@pytest.fixture(scope="module")
def cases(in_window):
    return in_window("viewport_sharing_cases.py", timeout=600)


def test_two_views_share_a_solver(cases):
    case = cases["two_views"]
    assert case["shared"] and case["solvers"] == 1
    near, far = case["lit"]
    assert 0 < far < 0.7 * near, "each has a camera of its own"
    # Twice the power is twice the light; half floats have 11 bits.
    assert case["brighter"] == approx([2.0, 2.0], rel=0.01)


def test_local_view_has_a_solver_of_its_own(cases):
    case = cases["local_view"]
    assert case["own"] and case["edits of the other"] == 0
    local, whole = case["patches"]
    assert 0 < local < whole, "the block is missing"
    assert case["shared again"]


def test_hidden_types_of_objects(cases):
    case = cases["object_types"]
    assert "mesh" in case["mesh"]["error"].lower()
    assert case["light"]["lit"] == 0


def test_pause_holds_edits(cases):
    case = cases["paused"]
    assert case["solutions while paused"] == 0
    assert case["line"].startswith("Paused") and "Paused" not in case["line after"]
    assert case["brighter"] > 1.5, "twice the power, from twice as far"


def test_an_error_shows_and_goes(cases):
    before, wrong, cured = cases["missing_image"]
    assert before["error"] == cured["error"] == ""
    assert max(before["text pixels"], cured["text pixels"]) < 10, "a few of Blender's own"
    assert "bricks" in wrong["error"] and "/nowhere/bricks.png" in wrong["error"]
    assert wrong["text pixels"] > 50 and "final" not in wrong["line"]
    assert wrong["lit"] == before["lit"] > 0, "the old picture stays"
    assert cured["line"].endswith("final")


def test_a_bug_is_told_once_in_the_console(cases):
    case = cases["internal_error"]
    assert all("console" in error and "a bug" in error for error in case["errors"])
    assert case["printed"] == 1 and case["after"] == ""
