# SPDX-License-Identifier: GPL-3.0-or-later
"""Direct light by shadow maps against Cycles, and against shadow rays."""

import json
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
IMAGES = ROOT / "tests" / "images"
sys.path.insert(0, str(IMAGES))
from compare import compare, compare_files, read_rgb  # noqa: E402

REFERENCES = json.loads((IMAGES / "references.json").read_text())
MODES = {mode: {"direct_light": mode} for mode in ("EXPLICIT", "SHADOW_MAPS")}

# Measured plus a quarter: relative RMS against Cycles .012 and .027 (rays: .008 and .017), and
# against rays by pixel .014 and .030. In the two rooms a frame hides the rim of the lamp from the
# walls, of which 64 points tell little.
LIKE_CYCLES = {"cornell_box": 0.015, "two_rooms": 0.033}
LIKE_RAYS = {"cornell_box": 0.017, "two_rooms": 0.038}


@pytest.fixture(scope="session")
def pictures(in_blender, tmp_path_factory):
    """pictures(scene) -> folder with a picture of each mode, and the reports"""
    done = {}

    def of(scene):
        if scene not in done:
            folder = tmp_path_factory.mktemp(scene)
            reports = in_blender("render_modes.py", ROOT / "blend_scenes" / f"{scene}.blend",
                                 REFERENCES[scene]["percentage"], folder, json.dumps(MODES),
                                 timeout=900)
            done[scene] = folder, reports
        return done[scene]

    return of


@pytest.mark.parametrize("scene", LIKE_CYCLES)
def test_shadow_maps_like_cycles(pictures, scene):
    folder, reports = pictures(scene)
    report = reports["SHADOW_MAPS"]
    assert report["error"] == ""
    assert report["direct"]["shadow_maps"] > 0 == reports["EXPLICIT"]["direct"]["shadow_maps"]
    result = compare_files(folder / "SHADOW_MAPS.exr", IMAGES / f"{scene}.exr")
    assert result.relative_rms <= LIKE_CYCLES[scene], str(result)
    assert abs(result.bias) <= 0.015, str(result)


@pytest.mark.parametrize("scene", LIKE_RAYS)
def test_shadow_maps_like_rays(pictures, scene):
    folder, _ = pictures(scene)
    result = compare(read_rgb(folder / "SHADOW_MAPS.exr"), read_rgb(folder / "EXPLICIT.exr"),
                     block=1)
    assert 0 < result.relative_rms <= LIKE_RAYS[scene], str(result)
