# SPDX-License-Identifier: GPL-3.0-or-later
"""Direct light by shadow maps against Cycles, and against shadow rays."""

import sys
from pathlib import Path

import pytest

IMAGES = Path(__file__).resolve().parents[1] / "images"
sys.path.insert(0, str(IMAGES))
from compare import compare, read_rgb  # noqa: E402

MODES = {mode: {"direct_light": mode} for mode in ("EXPLICIT", "SHADOW_MAPS")}

# Measured plus a quarter: relative RMS against Cycles .012 and .027 (rays: .008 and .017), and
# against rays by pixel .014 and .030. In the two rooms a frame hides the rim of the lamp from the
# walls, of which 64 points tell little.
LIKE_CYCLES = {"cornell_box": 0.015, "two_rooms": 0.033}
LIKE_RAYS = {"cornell_box": 0.017, "two_rooms": 0.038}


@pytest.mark.parametrize("scene", LIKE_CYCLES)
def test_shadow_maps_like_cycles(pictures, scene):
    of = pictures(scene, MODES)
    by_maps, by_rays = of["SHADOW_MAPS"], of["EXPLICIT"]
    assert by_maps.report["error"] == ""
    assert by_maps.report["direct"]["shadow_maps"] > 0 == by_rays.report["direct"]["shadow_maps"]
    result = compare(by_maps.pixels, read_rgb(IMAGES / f"{scene}.exr"))
    assert result.relative_rms <= LIKE_CYCLES[scene], str(result)
    assert abs(result.bias) <= 0.015, str(result)


@pytest.mark.parametrize("scene", LIKE_RAYS)
def test_shadow_maps_like_rays(pictures, scene):
    of = pictures(scene, MODES)
    result = compare(of["SHADOW_MAPS"].pixels, of["EXPLICIT"].pixels, block=1)
    assert 0 < result.relative_rms <= LIKE_RAYS[scene], str(result)
