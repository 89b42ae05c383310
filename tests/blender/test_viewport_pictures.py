# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of rendered viewports, pixel by pixel, beside renders of the same cameras."""

import types

import numpy as np
import pytest

# The picture is kept in half floats, of 11 bits, and so is what Blender draws it on. The camera
# comes from Blender's single precision matrices: its rays differ in the last bits, so that at the
# edge of a surface one of a pixel's 16 samples may hit the other side.
TWO_HALF_FLOATS = 2.0 * 2.0**-10
EDGE_PIXELS = 0.02


@pytest.fixture(scope="module")
def cases(in_window, tmp_path_factory):
    files = in_window("viewport_picture_cases.py", tmp_path_factory.mktemp("pictures"), timeout=600)

    def load(file):
        case = types.SimpleNamespace(**np.load(file))
        x0, y0, x1, y1 = case.border
        case.inside = case.viewport[y0:y1, x0:x1]
        case.around = np.ma.array(case.viewport, mask=False)
        case.around[y0:y1, x0:x1] = np.ma.masked
        return case

    return {name: load(file) for name, file in files.items()}


def assert_same(viewport, render):
    assert viewport.shape == render.shape
    scale = np.maximum(np.abs(render), 0.01 * render.max())
    error = (np.abs(viewport - render) / scale).max(axis=2)
    assert (error > TWO_HALF_FLOATS).mean() < EDGE_PIXELS


def test_through_the_camera(cases):
    case = cases["through_the_camera"]
    assert case.render.max() > 0.1, "there is light"
    assert_same(case.inside, case.render)


def test_border_of_the_camera(cases):
    case = cases["border_of_the_camera"]
    height, width, _ = case.viewport.shape
    x0, y0, x1, y1 = case.border
    assert (x1 - x0, y1 - y0) == pytest.approx((3 * width / 8, height / 4), abs=2)
    assert_same(case.inside, case.render)
    assert case.around.max() == 0, "nothing is drawn around it"


def test_border_of_the_region(cases):
    case = cases["border_of_the_region"]
    height, width, _ = case.viewport.shape
    assert case.border == pytest.approx([0.25 * width, 0.4 * height, 0.75 * width, 0.8 * height],
                                        abs=0.5)
    assert_same(case.inside, case.render)
    assert case.around.max() == 0


def test_orthographic(cases):
    case = cases["orthographic"]
    assert_same(case.inside, case.render)


def test_transparent_film(cases):
    case = cases["transparent_film"]
    alpha = case.render[..., 3]
    assert alpha.min() == 0 and alpha.max() == 1, "the box and nothing around it"
    assert_same(case.inside, case.render)
