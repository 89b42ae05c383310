# SPDX-License-Identifier: GPL-3.0-or-later
"""What a 3D viewport says of its solver and its picture."""

import json

import pytest

REPORT = json.dumps({"links": {"total": 10_234_567}, "patches": 37_123,
                     "timings_s": {"total": 1.44}})


@pytest.fixture(scope="module")
def status(addon_module):
    return addon_module("viewport_status")


def solver(**changes):
    return {"working": False, "paused": False, "stage": "", "fraction": 0.0, "error": "",
            "report": REPORT, "warnings": [], **changes}


def view(**changes):
    return {"making": "", "error": "", **changes}


def test_figures_of_a_finished_solution(status):
    line = status.status_of(solver(), view(), "FINAL").line
    assert line == "10.2 M links, 37.1 k patches, 1.4 s · final"


def test_progress_takes_the_place_of_the_figures(status):
    solving = solver(working=True, stage="Linking patches", fraction=0.424)
    assert status.status_of(solving, view(), "").line == "Linking patches 42%"


def test_the_picture_in_work(status):
    line = status.status_of(solver(), view(making="INTERLEAVED"), "QUICK").line
    assert line.endswith(" s · interleaved picture in work")


def test_pause_and_warnings(status):
    told = status.status_of(solver(paused=True, warnings=["a", "b"]), view(), "FINAL")
    assert told.line.startswith("Paused · ") and told.line.endswith(" · final · 2 warnings")
    assert told.warnings == ("a", "b")
    assert status.status_of(solver(warnings=["a"]), view(), "").line.endswith(" · 1 warning")


@pytest.mark.parametrize("of_solver, of_view", [("No light", ""), ("", "No light")])
def test_an_error_is_no_finished_picture(status, of_solver, of_view):
    told = status.status_of(solver(error=of_solver), view(error=of_view), "FINAL")
    assert told.error == "No light" and "final" not in told.line


@pytest.mark.parametrize("count, text", [(0, "0"), (999, "999"), (1000, "1 k"), (37_123, "37.1 k"),
                                         (123_456, "123 k"), (999_900, "1 M"),
                                         (2_500_000_000, "2.5 G")])
def test_shortened_counts(status, count, text):
    assert status.shortened(count) == text


@pytest.mark.parametrize("text, lines", [
    ("one two three", ["one two", "three"]),
    ("first\nsecond", ["first", "second"]),
    ("/a/path/without/spaces", ["/a/path/", "without/", "spaces"]),
    ("at /a/path", ["at", "/a/path"]),
    ("", []),
])
def test_text_is_wrapped(status, text, lines):
    assert status.wrapped(text, 8, len) == lines


def test_text_in_a_region_without_room(status):
    assert status.wrapped("abc", 0, len) == ["a", "b", "c"]
