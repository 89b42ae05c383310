# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator "Difference to Image": colours and figures of renders of known radiance, errors."""

import numpy as np
import pytest
from pytest import approx

RED, GREEN = 0, 1


@pytest.fixture(scope="module")
def cases(in_blender, tmp_path_factory):
    return in_blender("difference_cases.py", tmp_path_factory.mktemp("pictures"))


def encode(linear):
    return 1.055 * linear ** (1 / 2.4) - 0.055


def shown(first, second):
    """What a display is to show of grey that changes from `first` to `second`, linear radiance."""
    strength = min(1.0, 4 * abs(encode(second) - encode(first)))
    linear = ((strength + 0.055) / 1.055) ** 2.4
    return [linear, 0, 0, 1] if second < first else [0, linear, 0, 1]


def test_colours_and_figures(cases):
    case = cases["darker_and_brighter"]
    assert case["error"] == ""
    pixels, figures = np.array(case["pixels"]), case["figures"]
    assert pixels.shape == (6, 8, 4)
    # The first render was saved in half floats: 11 bits, four times of which tell here.
    left, right = pixels[:, :4], pixels[:, 4:]
    assert left == approx(np.broadcast_to(shown(0.2, 0.18), left.shape), abs=1e-3)
    assert right == approx(np.broadcast_to(shown(0.4, 0.42), right.shape), abs=1e-3)
    assert left[0, 0, RED] > 10 * left[0, 0, GREEN]
    assert figures == approx({"mean_first": 0.3, "mean_second": 0.3, "largest": 0.02,
                              "relative_rms": 0.02 / 0.3}, rel=0.01)


def test_the_output_settings_stay(cases):
    assert cases["darker_and_brighter"]["output"] == ["PNG", "16"]


def test_no_file_is_left(cases):
    assert cases["darker_and_brighter"]["left"] == []


def test_the_image_is_made_over(cases):
    case = cases["again_at_another_size"]
    assert case["images"] == 1
    pixels = np.array(case["pixels"])
    assert pixels.shape == (6, 12, 4)
    assert pixels[..., :3].max() < 1e-3, "a render and its own file"
    assert case["figures"]["relative_rms"] < 1e-3


def test_sizes_that_differ_are_named(cases):
    error = cases["again_at_another_size"]["wrong_size"]
    assert "8 x 6" in error and "12 x 6" in error


def test_another_render_slot(cases):
    case = cases["other_slot"]
    pixels = np.array(case["pixels"])
    assert pixels[:, :4, :3].max() < 1e-6
    assert pixels[:, 4:] == approx(np.broadcast_to(shown(0.4, 0.2), (6, 4, 4)), abs=1e-5)
    assert case["active"] == 1, "the shown slot stays"
    assert "Slot 1 is the one that is shown" in case["shown"]
    assert "no render result in slot 5" in case["empty"]


def test_errors_say_what_to_do(cases):
    assert "render an image (F12) first" in cases["before_any_render"]["error"]
    assert "choose one in the panel Compare" in cases["no_image_chosen"]["error"]


def test_a_picture_of_eight_bits(cases):
    # Half a step of 1 / 255, four times, as a linear value.
    assert np.array(cases["eight_bits"]["pixels"])[..., :3].max() < 4 * 0.5 / 255 / 12.92 + 1e-4


def test_undo(cases):
    assert cases["undone"]["states"] == [True, False]
    assert cases["undone"]["error"] == ""
