# SPDX-License-Identifier: GPL-3.0-or-later
"""Arithmetic of material colours: constants, textures, and when two must be baked into one."""

import numpy as np
import pytest
from pytest import approx


@pytest.fixture(scope="module")
def c(addon_module):
    return addon_module("colour")


@pytest.fixture
def texture(c):
    def make(values, name="T", mapping=None, missing=None):
        """values: (h, w, 3)"""
        values = np.asarray(values, np.float32)
        rgba = np.ones((*values.shape[:2], 4), np.float32)
        rgba[..., :3] = values
        return c.Texture(name, name, mapping or c.Mapping(), lambda: rgba, missing)

    return make


def textured(c, made, factor=(1.0, 1.0, 1.0)):
    return c.Colour(factor, made)


def test_srgb_decoding(c):
    """Figures of IEC 61966-2-1; 0.04045 is where its two pieces meet."""
    encoded = np.array([0.0, 0.04045, 0.5, 1.0], np.float32)
    assert c.srgb_to_linear(encoded) == approx([0, 0.0031308, 0.2140411, 1], rel=1e-4)
    assert c.srgb_to_linear(encoded).dtype == np.float32


@pytest.mark.parametrize("channels, expected", [
    (1, [7, 7, 7, 1]), (2, [7, 7, 7, 8]), (3, [7, 8, 9, 1]), (4, [7, 8, 9, 10])])
def test_channels(c, channels, expected):
    flat = np.tile(np.arange(7, 7 + channels, dtype=np.float32), 6)
    rgba = c.expand_to_rgba(flat, 3, 2, channels)
    assert rgba.shape == (2, 3, 4)
    assert (rgba == expected).all()


def test_constants(c):
    red, half = c.constant((1, 0, 0, 1)), c.constant(0.5)
    assert c.multiply(red, half).factor == (0.5, 0, 0)
    assert c.add(red, half).factor == (1.5, 0.5, 0.5)
    assert c.mix(c.constant(0.25), red, half).factor == approx((0.875, 0.125, 0.125))


def test_constant_times_texture_keeps_the_texture(c, texture):
    checker = texture(np.ones((2, 2, 3)))
    product = c.multiply(c.constant((0.5, 0.25, 1)), textured(c, checker))
    assert product.texture is checker and product.factor == (0.5, 0.25, 1)


def test_black_times_texture_needs_no_texture(c, texture):
    assert c.multiply(c.BLACK, textured(c, texture(np.ones((2, 2, 3))))) == c.BLACK


def test_sums_of_one_texture_stay_that_texture(c, texture):
    checker = texture(np.ones((2, 2, 3)))
    total = c.add(textured(c, checker, (0.25,) * 3), textured(c, checker, (0.5,) * 3))
    assert total.texture is checker and total.factor == (0.75,) * 3


def test_two_textures_are_baked_at_the_finer_size(c, texture):
    fine = texture(np.arange(24).reshape(4, 2, 3), "fine")
    flat = texture(np.full((1, 1, 3), 2.0), "flat")
    product = c.multiply(textured(c, fine), textured(c, flat))
    assert product.texels() == approx(2.0 * np.arange(24).reshape(4, 2, 3))
    assert product.texture.key != fine.key


def test_other_coordinates_cannot_be_combined(c, texture):
    first = textured(c, texture(np.ones((1, 1, 3)), "a"))
    second = textured(c, texture(np.ones((1, 1, 3)), "b", c.Mapping("Other")))
    with pytest.raises(c.UnsupportedShading, match="coordinates"):
        c.add(first, second)


def test_a_missing_image_stays_missing(c, texture):
    gone = textured(c, texture(np.ones((1, 1, 3)), "gone", missing="/nowhere.png"))
    mixed = c.mix(c.constant(0.5), gone, c.WHITE)
    assert mixed.texture.missing_path == "/nowhere.png"


def test_equal_recipes_have_equal_keys(c, texture):
    """The table of textures adds one image for materials that combine alike."""
    def recipe():
        return c.add(textured(c, texture(np.ones((1, 1, 3)), "a")), c.constant(0.5))

    assert recipe().texture.key == recipe().texture.key


def test_resampling_keeps_the_mean_and_constants(c):
    noise = np.random.default_rng(1).random((4, 6, 3)).astype(np.float32)
    assert c.resample(noise, 8, 12).mean(axis=(0, 1)) == approx(noise.mean(axis=(0, 1)), rel=1e-5)
    assert c.resample(np.full((3, 5, 3), 0.7, np.float32), 8, 9) == approx(0.7)


def test_mapping_applies_an_affine_map(c):
    mapping = c.Mapping("UV", ((0.0, -3.0, 0.5), (2.0, 0.0, 0.25)))
    assert mapping.apply(np.array([[1.0, 1.0], [0.0, 2.0]], np.float32)) == approx(
        np.array([[-2.5, 2.25], [-5.5, 0.25]]))
