# SPDX-License-Identifier: GPL-3.0-or-later
"""The solution is kept from frame to frame without a setting, and let go when a job ends."""

import pytest

ALL = ["model", "pruning", "direct_light", "transport", "solve", "evaluation", "display"]


@pytest.fixture(scope="module")
def cases(in_blender, tmp_path_factory):
    return in_blender("session_cases.py", tmp_path_factory.mktemp("frames"))


def ran(case):
    """The stages that ran, one list a render."""
    return [[name for name, what in report["stages"].items() if what == "run"]
            for report in case["reports"]]


def test_a_moving_camera_solves_once(cases):
    assert ran(cases["camera_moves"]) == [ALL, ["display"], ["display"]]
    for report in cases["camera_moves"]["reports"][1:]:
        times = report["timings_s"]
        assert times["links"] == times["direct"] == times["solve"] == 0 < times["display"]
        assert report["links"]["total"] == cases["camera_moves"]["reports"][0]["links"]["total"]


def test_a_moved_object_rebuilds(cases):
    assert ran(cases["block_moves"]) == [ALL, ["display"], ALL]


def test_a_brighter_lamp_keeps_the_links(cases):
    assert ran(cases["lamp_brightens"]) == [ALL, ALL[2:], ["display"]]


def test_nothing_is_left_after_a_job(cases):
    for name in ("camera_moves", "block_moves", "lamp_brightens", "view_layers", "two_scenes",
                 "failure"):
        assert cases[name]["left"] == 0, name


def test_persistent_data_outlives_the_job(cases):
    assert ran(cases["persistent_data"]) == [ALL, ["display"], ["display"], ["display"]]
    assert cases["persistent_data"]["left"] == 1
    assert cases["other_engine"]["left"] == 0


def test_view_layers_keep_their_own(cases):
    assert ran(cases["view_layers"]) == [ALL, ALL, ["display"], ["display"]]
    empty, full = cases["view_layers"]["reports"][2:]
    assert empty["leaves"] < full["leaves"]


def test_scenes_keep_nothing_of_each_other(cases):
    assert ran(cases["two_scenes"]) == [ALL, ALL, ALL]


def test_a_job_after_one_that_failed(cases):
    assert ran(cases["failure"]) == [ALL, ALL]


def test_the_add_on_leaves_nothing_behind(cases):
    assert ran(cases["add_on_off"]) == [ALL, ALL]
    assert cases["add_on_off"]["left"] == 0
    assert cases["add_on_off"]["handlers"] == 0
