# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets of the settings: the operator, artists' own, and what the panels grey out."""

import json

import pytest


@pytest.fixture(scope="module")
def cases(in_blender, root, tmp_path_factory):
    return in_blender("preset_cases.py", root / "blend_scenes" / "cornell_box.blend",
                      tmp_path_factory.mktemp("reports"))


def approximately(values):
    """Blender's floats have 32 bits, as the core's have."""
    return {name: pytest.approx(value, rel=1e-6) if isinstance(value, float) else value
            for name, value in values.items()}


@pytest.mark.parametrize("preset", ["FINAL", "PREVIEW", "PAPER"])
def test_operator_sets_all_but_device_and_report(cases, preset):
    case = cases["applied"][preset]
    assert case["set"] == approximately(case["wanted"])
    assert {"solver", "report_path"}.isdisjoint(case["wanted"])
    assert case["kept"] == ["CPU", "//report.json"]


def test_presets_differ(cases):
    applied = [case["set"] for case in cases["applied"].values()]
    assert all(a != b for i, a in enumerate(applied) for b in applied[:i])


def test_paper_renders_as_the_paper(cases):
    report = json.loads(cases["paper_rendered"])
    assert report["error"] == ""
    assert report["links"]["antiradiance"] > 0 and report["direct"]["shadow_maps"] > 0
    assert report["pruning"]["method"] == "HEURISTIC_2_THEN_1" and report["pruning"]["removed"] > 0
    assert report["solve"]["iterations"] == 4
    assert report["display"]["mode"] == "FINAL_SHOOTING"


def test_undo(cases):
    case = cases["undone"]
    assert case["after"]["interleave"] == 1 and case["after"]["visibility"] == "IMPLICIT"
    assert case["undone"]["interleave"] == 3 and case["undone"]["visibility"] == "EXPLICIT"


def test_preset_of_an_artist(cases):
    case = cases["saved_by_an_artist"]
    assert case["before"]["direction_bins"] == 96
    assert case["loaded"] == approximately(case["before"])
    assert case["solver"] == "OPENGL", "a preset says nothing of the device"
    assert not case["there"]


def test_panels_grey_out_what_has_no_effect(cases):
    greyed = {preset: set(names) for preset, names in cases["greyed_out"].items()}
    assert greyed["FINAL"] == {"ray_budget", "pruning", "pruning_directions", "bin_map_size"}
    assert greyed["PAPER"] == {"visibility_rays", "ray_budget"}
