# SPDX-License-Identifier: GPL-3.0-or-later
"""Real geometry: models that nobody here made, with slivers, T-junctions and parts that overlap."""

import json
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
IMAGES = ROOT / "tests" / "images"
MODELS = ROOT.parent / "shared" / "scenes"
sys.path.insert(0, str(IMAGES))
from compare import block_means, compare, read_rgb  # noqa: E402

MODERN_HALL = ROOT / "blend_scenes" / "modern_hall.blend"
PERCENTAGE = json.loads((IMAGES / "references.json").read_text())["modern_hall"]["percentage"]

# Measured .021. The target is .15.
MODERN_HALL_FLOOR = 0.03

# IMPLICIT takes 22 GiB for the 420 million links of Modern Hall's 28,743 lit sides, and takes no more
# than .8 of what is free.
IMPLICIT_NEEDS = 27 * 2**30  # bytes


def test_modern_hall_like_cycles(render):
    picture = render(MODERN_HALL, f"scene.render.resolution_percentage = {PERCENTAGE}")
    assert picture.exit_code == 0, picture.log
    assert picture.report["solve"]["converged"]
    assert picture.report["leaves"] > 50_000
    assert picture.report["peak_memory_bytes"] < 4e9
    pixels = picture.combined[..., :3]
    assert pixels.min() >= 0
    result = compare(pixels, read_rgb(IMAGES / "modern_hall.exr"))
    assert result.relative_rms <= MODERN_HALL_FLOOR, str(result)
    for name, count in (("Wall_0002", 2327), ("Wall_0003", 105)):
        assert any(f"'{name}': {count} zero-area" in w for w in picture.report["warnings"])


def available_memory():
    lines = Path("/proc/meminfo").read_text().splitlines()
    (line,) = (line for line in lines if line.startswith("MemAvailable"))
    return 1024 * int(line.split()[1])


def test_implicit_says_beforehand_that_modern_hall_is_too_much(render):
    if available_memory() > IMPLICIT_NEEDS:
        pytest.skip("this machine has the memory for it")
    picture = render(MODERN_HALL, visibility="IMPLICIT")
    assert picture.exit_code == 1
    assert not picture.picture_files
    error = picture.report["error"]
    assert "Explicit" in error and "million links" in error and "'SpotHolder_" in error
    assert picture.report["timings_s"]["total"] < 60


@pytest.fixture(scope="module")
def soda_hall(run_blender, tmp_path_factory):
    if not (MODELS / "soda_hall").is_dir():
        pytest.skip("the model of Soda Hall is not here; its licence keeps it out of the repository")
    folder = tmp_path_factory.mktemp("soda_hall")
    made = run_blender("-P", ROOT / "blend_scenes" / "make_scenes.py", "--", "--models", MODELS,
                       "--output", folder, "soda_hall")
    assert made.returncode == 0, made.stdout
    return folder / "soda_hall.blend"


@pytest.fixture(scope="module")
def soda_hall_pictures(in_blender, soda_hall, tmp_path_factory):
    """{visibility: (pixels, report)}; coarser than the default, for the sake of time."""
    folder = tmp_path_factory.mktemp("soda_hall_pictures")
    coarse = {"max_patch_size": 3.0, "link_threshold": 0.1}
    modes = {mode: {"visibility": mode, **coarse} for mode in ("EXPLICIT", "IMPLICIT")}
    reports = in_blender("render_modes.py", soda_hall, 20, folder, json.dumps(modes), timeout=600)
    return {mode: (read_rgb(folder / f"{mode}.exr"), reports[mode]) for mode in modes}


@pytest.mark.parametrize("visibility", ["EXPLICIT", "IMPLICIT"])
def test_soda_hall(soda_hall_pictures, visibility):
    pixels, report = soda_hall_pictures[visibility]
    assert report["error"] == ""
    assert report["solve"]["converged"]
    assert report["leaves"] > 5000
    assert np.isfinite(pixels).all()
    assert pixels.min() >= 0
    # No part of the hallway is black, not even where no lamp shines.
    assert block_means(pixels, 4).max(axis=2).min() > 0.01 * pixels.mean()


@pytest.fixture(scope="module")
def soda_hall_pruning(in_blender, soda_hall, tmp_path_factory):
    """What the report says of pruning; so coarse, and lit along the links, for the sake of time."""
    folder = tmp_path_factory.mktemp("soda_hall_pruning")
    coarse = {"max_patch_size": 6.0, "link_threshold": 0.3, "direct_light": "IMPLICIT"}
    modes = {"EVALUATED": {"evaluate_pruning": True, "display": "PATCHES", **coarse}}
    reports = in_blender("render_modes.py", soda_hall, 2, folder, json.dumps(modes), timeout=600)
    return reports["EVALUATED"]["pruning"]


def test_pruning_of_soda_hall(soda_hall_pruning):
    rules = soda_hall_pruning["evaluation"]
    for name, rule in rules.items():
        assert rule["explicit"] == soda_hall_pruning["explicit"], name
        assert rule["removed"] - rule["incorrect"] == rule["explicit"] - rule["not_removed"], name
        # The paper's were wrong in 4.6 % (1) and 2.1 % (2) there. Measured 2.0, 1.1 and 1.3 %.
        assert rule["incorrect"] < 0.05 * rule["removed"], name
        assert rule["solution"]["converged"], name
    # Of what is blocked: measured 79 %. The paper's found 53 % of what it does with rays.
    rule = rules["HEURISTIC_2"]
    assert rule["removed"] - rule["incorrect"] > 0.53 * rule["explicit"]


def test_conservative_pruning_of_soda_hall_keeps_the_light(soda_hall_pruning):
    rule = soda_hall_pruning["evaluation"]["CONSERVATIVE"]
    assert rule["removed"] > 0.1 * soda_hall_pruning["explicit"]
    assert rule["incorrect_radiance"] == 0
    assert rule["incorrect"] < 0.00001 * rule["removed"]  # measured 0 of 448,311
    light, unpruned = rule["solution"], soda_hall_pruning["unpruned"]
    # No light comes in where a wall kept it out. Measured .46, and .53 before pruning.
    assert light["largest_leak"] < 1.05 * unpruned["largest_leak"]
    # Measured .233, and .197 before pruning.
    assert light["relative_rms"] < 1.3 * unpruned["relative_rms"]


def test_soda_hall_stays_out_of_the_repository(run_blender):
    made = run_blender("-P", ROOT / "blend_scenes" / "make_scenes.py", "--", "soda_hall")
    assert made.returncode != 0
    assert "licence" in made.stdout
    assert not (ROOT / "blend_scenes" / "soda_hall.blend").exists()
