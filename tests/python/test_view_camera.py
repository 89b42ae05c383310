# SPDX-License-Identifier: GPL-3.0-or-later
"""The matrices and the border of a 3D viewport -> the core's camera."""

import numpy as np
import pytest
from pytest import approx

SIZE = 400, 300


@pytest.fixture(scope="module")
def view_camera(addon_module):
    return addon_module("view_camera")


def perspective(near, far):
    return np.array([[2, 0, 0, 0], [0, 2, 0, 0],
                     [0, 0, -(far + near) / (far - near), -2 * far * near / (far - near)],
                     [0, 0, -1, 0]])


def orthographic(near, far):
    return np.array([[0.5, 0, 0, 0], [0, 0.5, 0, 0],
                     [0, 0, -2 / (far - near), -(far + near) / (far - near)], [0, 0, 0, 1]])


def test_depth_of_a_perspective(view_camera):
    assert view_camera.depth_range(perspective(0.1, 50.0), False) == approx((0.1, 50.0))


def test_depth_of_a_plane_too_far_for_single_precision(view_camera):
    near, far = view_camera.depth_range(perspective(0.01, 1e9).astype(np.float32), False)
    assert near == approx(0.01) and far == view_camera.FARTHEST


@pytest.mark.parametrize("near, far", [(0.1, 50.0), (-100.0, 100.0)])
def test_depth_of_an_orthographic_view(view_camera, near, far):
    assert view_camera.depth_range(orthographic(near, far), True) == approx((near, far))


def test_the_eye_of_an_orthographic_view_moves_back(view_camera):
    """It looks along +X from (1, 2, 3) and shows what is up to 100 m behind it as well."""
    to_world = np.array([[0, 0, -1, 1], [-1, 0, 0, 2], [0, 1, 0, 3], [0, 0, 0, 1]])
    camera = view_camera.camera_settings(orthographic(-100, 100), to_world, True, SIZE,
                                         view_camera.WHOLE)
    assert camera["matrix"][:3, 3] == approx([-99, 2, 3], abs=1e-4)
    assert (camera["clip_start"], camera["clip_end"]) == approx((0, 200))
    assert camera["left"], camera["top"] == approx((-2, 2))
    assert camera["type"] == "ORTHO" and camera["border"] == (0, 0, *SIZE)


@pytest.mark.parametrize("sides, pixels", [
    ((0.25, 0.75, 0.1, 0.5), (100, 30, 300, 150)),
    ((-0.5, 0.5, 0.0, 3.0), (0, 0, 200, 300)),  # partly out of sight
    ((1.2, 1.5, 0.0, 1.0), None),
    ((0.5, 0.501, 0.0, 1.0), None),             # narrower than a pixel
])
def test_border(view_camera, sides, pixels):
    assert view_camera.border_pixels(sides, *SIZE) == pixels


def test_a_border_in_the_frame_of_a_camera(view_camera):
    """The frame lies in the right half of the region, half as high; the border is its left half."""
    sides = view_camera.inside((0.0, 0.5, 0.0, 1.0), (0, 2, -1, 1), (-2, 2, -2, 2))
    assert sides == approx((0.5, 0.75, 0.25, 0.75))


def test_nothing_to_render(view_camera):
    outside = view_camera.camera_settings(perspective(0.1, 50), np.eye(4), False, SIZE,
                                          (2.0, 3.0, 0.0, 1.0))
    assert outside is None
