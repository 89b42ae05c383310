# SPDX-License-Identifier: GPL-3.0-or-later
"""What an edit makes the solver of a rendered viewport do, and what it lets be."""

import pytest

@pytest.fixture(scope="module")
def edits(in_window, tmp_path_factory):
    return in_window("viewport_edit_cases.py", tmp_path_factory.mktemp("images"), timeout=600)


@pytest.mark.parametrize("edit", ["lamp energy", "lamp colour", "material colour",
                                  "emission strength"])
def test_links_outlive_edits_of_light(edits, edit):
    case = edits[edit]
    assert case["edits"] == 1 and case["solutions"] >= 1
    assert case["stages"]["model"] == case["stages"]["pruning"] == "kept", "patches and links"
    assert case["stages"]["solve"] == "run"


def test_direct_light_outlives_edits_of_a_colour(edits):
    assert edits["material colour"]["stages"]["direct_light"] == "kept"
    assert edits["lamp energy"]["stages"]["direct_light"] == "run"


@pytest.mark.parametrize("edit", ["object moved", "modifier changed", "object hidden",
                                  "object shown", "vertex in Edit Mode", "option by script"])
def test_geometry_is_linked_anew(edits, edit):
    case = edits[edit]
    assert case["edits"] == 1 and case["solutions"] >= 1
    assert case["stages"]["model"] == "run"


@pytest.mark.parametrize("edit", ["image generated", "colour space", "image painted",
                                  "image loaded", "image loaded again"])
def test_images_are_read_again_when_they_change(edits, edit):
    assert edits[edit]["edits"] == 1 and edits[edit]["images read"] >= 1


@pytest.mark.parametrize("edit", ["lamp energy", "material colour", "object moved", "selection"])
def test_images_are_not_read_again_for_other_edits(edits, edit):
    assert edits[edit]["images read"] == 0


@pytest.mark.parametrize("edit", ["exposure", "view transform", "selection", "camera"])
def test_what_changes_no_light_solves_nothing(edits, edit):
    assert (edits[edit]["edits"], edits[edit]["solutions"]) == (0, 0)
