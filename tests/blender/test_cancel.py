# SPDX-License-Identifier: GPL-3.0-or-later
"""Esc ends a render within half a second, whatever it is doing."""

from pathlib import Path

import pytest

SCENE = Path(__file__).resolve().parents[2] / "blend_scenes" / "cornell_box.blend"
STAGES = ["Reading the scene", "Checking the scene", "Building the patch hierarchy",
          "Linking patches", "Testing visibility", "Sorting links", "Direct light", "Solving",
          "Display"]


@pytest.fixture(scope="module")
def seconds(in_blender):
    return in_blender("cancel_cases.py", SCENE)


def test_all_stages_are_tried(seconds):
    assert list(seconds) == STAGES


@pytest.mark.parametrize("stage", STAGES)
def test_cancel(seconds, stage):
    assert seconds[stage] is not None and seconds[stage] < 0.5
