# SPDX-License-Identifier: GPL-3.0-or-later
"""The core's camera sees through each pixel what Cycles sees there."""

import re

import numpy as np
import pytest
from multilayer import read_multilayer

# Cycles' positions are float32 at up to 60 m; a pixel is 1/64 of the frame.
PIXELS = 0.02

CASES = ["plain", "shifted", "portrait", "vertical_fit", "wide_pixels", "tall_pixels", "percentage",
         "scaled_object", "orthographic", "orthographic_shifted", "border"]


@pytest.fixture(scope="module")
def cameras(in_blender, tmp_path_factory):
    folder = tmp_path_factory.mktemp("cameras")
    return folder, in_blender("camera_cases.py", folder)


@pytest.mark.parametrize("name", CASES)
def test_pixels_look_where_cycles_looks(cameras, name):
    folder, described = cameras
    camera = described[name]
    passes = read_multilayer(folder / f"{name}.exr")
    seen = passes["Position"][::-1].astype(float)  # row 0 below
    x0, y0, x1, y1 = camera["border"]
    assert seen.shape == (y1 - y0, x1 - x0, 3)

    to_world = np.array(camera["matrix"])
    local = (seen - to_world[:3, 3]) @ to_world[:3, :3]  # a rotation: its inverse is its transpose
    depth = -local[..., 2]
    plane = local[..., :2] / (depth[..., None] if camera["type"] == "PERSP" else 1.0)
    # Pixel coordinates of where Cycles' rays went, by the core's frame.
    x = (plane[..., 0] - camera["left"]) / (camera["right"] - camera["left"]) * camera["width"]
    y = (plane[..., 1] - camera["bottom"]) / (camera["top"] - camera["bottom"]) * camera["height"]
    wanted_y, wanted_x = np.mgrid[y0:y1, x0:x1] + 0.5
    assert np.abs(x - wanted_x).max() < PIXELS
    assert np.abs(y - wanted_y).max() < PIXELS
    # Blender's Z pass is the depth along the view axis, which the core's Depth is to match.
    assert passes["Depth"][::-1] == pytest.approx(depth, rel=1e-4)


def test_size_follows_the_percentage(cameras):
    camera = cameras[1]["percentage"]
    assert (camera["width"], camera["height"]) == (64 * 37 // 100, 48 * 37 // 100)


@pytest.mark.parametrize("name, words", [("panoramic", r"'Camera'.*pano.*Perspective or Orthographic"),
                                         ("lamp_as_camera", r"'Lamp'.*Perspective or Orthographic")])
def test_unsupported_cameras_are_refused(cameras, name, words):
    assert re.search(words, cameras[1][name])
