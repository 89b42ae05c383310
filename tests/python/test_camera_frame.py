# SPDX-License-Identifier: GPL-3.0-or-later
"""Projection matrix -> view frame, border -> pixels."""

import types

import numpy as np
import pytest
from pytest import approx


@pytest.fixture(scope="module")
def camera(addon_module):
    return addon_module("camera")


FRAME = (-0.3, 0.7, -0.2, 0.4)  # left, right, bottom, top


def test_perspective(camera):
    """glFrustum's matrix with the frame on the plane at distance 1."""
    left, right, bottom, top = FRAME
    matrix = np.array([[2 / (right - left), 0, (right + left) / (right - left), 0],
                       [0, 2 / (top - bottom), (top + bottom) / (top - bottom), 0],
                       [0, 0, -1, -0.2], [0, 0, -1, 0]])
    assert camera.view_frame(matrix, False) == approx(FRAME)


def test_orthographic(camera):
    """glOrtho's matrix."""
    left, right, bottom, top = FRAME
    matrix = np.array([[2 / (right - left), 0, 0, -(right + left) / (right - left)],
                       [0, 2 / (top - bottom), 0, -(top + bottom) / (top - bottom)],
                       [0, 0, -0.02, -1], [0, 0, 0, 1]])
    assert camera.view_frame(matrix, True) == approx(FRAME)


def settings(x0, x1, y0, y1, use=True):
    return types.SimpleNamespace(use_border=use, border_min_x=x0, border_max_x=x1,
                                 border_min_y=y0, border_max_y=y1)


def test_border(camera):
    frame = camera.frame_of(settings(0.25, 0.5, 0.1, 1.0), 200, 100)
    assert frame.border == (50, 10, 100, 100) and frame.size == (50, 90)


def test_border_is_cut_in_single_precision(camera):
    """0.7 x 10 is 6.99..9 in double precision of the single .7, and 7 in Blender."""
    value = float(np.float32(0.7))
    assert int(value * 10) == 6
    assert camera.frame_of(settings(0.0, value, 0.0, 1.0), 10, 10).border[2] == 7


def test_border_that_is_off(camera):
    assert camera.frame_of(settings(0.25, 0.5, 0.1, 1.0, use=False), 20, 10).size == (20, 10)
