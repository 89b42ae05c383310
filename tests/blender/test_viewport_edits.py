# SPDX-License-Identifier: GPL-3.0-or-later
"""What an edit makes the solver of a rendered viewport do, and what it lets be."""

import pytest

LIGHT = {"direct", "solve"}  # stages that see the light; those before them see where surfaces are


@pytest.fixture(scope="module")
def edits(in_window):
    return in_window("viewport_edit_cases.py", timeout=600)


@pytest.mark.parametrize("edit", ["lamp energy", "lamp colour", "material colour",
                                  "emission strength"])
def test_links_outlive_edits_of_light(edits, edit):
    case = edits[edit]
    assert case["edits"] == 1
    run = {stage for stage, what in case["stages"].items() if what == "run"}
    assert run and run <= LIGHT | {"display"}, case["stages"]


@pytest.mark.parametrize("edit", ["object moved", "modifier changed", "object hidden",
                                  "object shown", "vertex in Edit Mode", "option by script"])
def test_geometry_is_linked_anew(edits, edit):
    case = edits[edit]
    assert case["edits"] == 1 and case["solutions"] >= 1
    assert case["stages"]["links"] == "run"


@pytest.mark.parametrize("edit", ["exposure", "view transform", "selection", "camera"])
def test_what_changes_no_light_solves_nothing(edits, edit):
    assert (edits[edit]["edits"], edits[edit]["solutions"]) == (0, 0)
