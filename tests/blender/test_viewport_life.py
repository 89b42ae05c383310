# SPDX-License-Identifier: GPL-3.0-or-later
"""Rendered viewports end with all that belongs to them, and outlive what happens to the scene."""

import pytest

NOTHING = {"viewports": 0, "solvers": 0, "timer": False, "pictures": 0}


@pytest.fixture(scope="module")
def cases(in_window):
    return in_window("viewport_life_cases.py", timeout=600)


@pytest.mark.parametrize("end", ["shading", "engine", "other_editor", "closed_area", "new_file"])
def test_what_ends_a_viewport_leaves_nothing(cases, end):
    assert cases[end] == NOTHING


def test_disabling_the_add_on_leaves_nothing(cases):
    case = cases["disabled"]
    assert case["left"] == NOTHING
    assert case["threads"] <= -2, "of the solver and of the view"


def test_undo_and_redo_while_there_is_work(cases):
    deleted, moved, before, moved_again, deleted_again = cases["undone_and_redone"]
    assert [case["block"] for case in cases["undone_and_redone"]] == [None, 1.0, 0.0, 1.0, None]
    assert not any(case["error"] for case in cases["undone_and_redone"])
    assert deleted["patches"] < before["patches"]
    assert moved_again["patches"] == moved["patches"]
    assert deleted_again["patches"] == deleted["patches"]


def test_many_cycles_of_shading_leave_nothing(cases):
    few, many = cases["many_cycles"]
    assert many == few
    assert few["pictures"] == few["viewports"] == few["solvers"] == 0
