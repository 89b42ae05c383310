# SPDX-License-Identifier: GPL-3.0-or-later
"""Each node set-up -> albedo, emission and textures that the core is told."""

import numpy as np
import pytest
from pytest import approx

VIEWPORT = [0.1, 0.2, 0.3]
BLACK = [0, 0, 0]
HALF_SRGB = ((0.5 + 0.055) / 1.055) ** 2.4  # what 0.5 in an sRGB file stands for
RAW = np.array([[[1, 0, 0], [0, 1, 0]], [[0, 0, 1], [0.5, 0.5, 0.5]]])  # row 0 at the bottom
# Byte images hold .5 as 128/255; half of a byte's step is .002.
BYTE = 0.0025


@pytest.fixture(scope="module")
def cases(in_blender):
    return in_blender("material_cases.py")


CONSTANTS = {  # case: (albedo, emission)
    "no_material": ([0.8] * 3, BLACK),
    "without_nodes": (VIEWPORT, BLACK),
    "principled": ([0.2, 0.4, 0.6], BLACK),
    "principled_emission": ([0.5] * 3, [3, 1.5, 0]),
    "diffuse": ([0.7, 0.6, 0.5], BLACK),
    "emission": (BLACK, [8, 4, 2]),
    "mix": ([0.75, 0, 0.25], BLACK),
    "mix_with_linked_factor": ([0.5, 0, 0], [0, 0, 2]),
    "mix_of_which_one_side_shows": ([0.5] * 3, BLACK),
    "add": ([0.5] * 3, [0, 2, 0]),
    "nested": ([0.75, 0.75, 0.5], [0, 0, 0.5]),
    "through_reroutes": ([0.3, 0.2, 0.1], BLACK),
    "through_a_group": ([0.6, 0.5, 0.4], BLACK),
    "muted_node_passes_on": ([0.25] * 3, BLACK),
    "colour_arithmetic": ([0.5, 0.25, 0], [6, 0, 0]),
    "new_mix_node": ([0.5, 0.5, 0], BLACK),
    "nothing_on_the_output": (BLACK, BLACK),
    "texture_without_image": (BLACK, BLACK),
}


@pytest.mark.parametrize("name", CONSTANTS)
def test_constant(cases, name):
    albedo, emission = CONSTANTS[name]
    case = cases[name]
    assert case["albedo"] == approx(albedo, abs=1e-6)
    assert case["emission"] == approx(emission, abs=1e-6)
    assert case["albedo_texture"] == case["emission_texture"] == -1
    assert case["uv"] is None
    assert case["warnings"] == []


FALLBACKS = {  # case: what the warning says
    "metallic": "it is metallic",
    "linked_metallic": "it is metallic",
    "transmission": "it transmits light",
    "glass": "Glass BSDF",
    "procedural_texture": "Noise Texture",
    "texture_of_generated_coordinates": "Generated",
}


@pytest.mark.parametrize("name", FALLBACKS)
def test_fallback_to_viewport_colour_says_why(cases, name):
    case = cases[name]
    assert case["albedo"] == approx(VIEWPORT) and case["emission"] == BLACK
    (warning,) = case["warnings"]
    assert warning.startswith(f"Material '{name}': it is rendered in its viewport colour")
    assert FALLBACKS[name] in warning


NOTES = {
    "transparent_alpha": ([0.5] * 3, "opaque"),
    "bump": ([0.5] * 3, "normal or bump map"),
    "no_output": (BLACK, "no Material Output"),
}


@pytest.mark.parametrize("name", NOTES)
def test_what_is_left_out_is_noted(cases, name):
    albedo, words = NOTES[name]
    assert cases[name]["albedo"] == approx(albedo)
    (warning,) = cases[name]["warnings"]
    assert f"'{name}'" in warning and words in warning


def textured(case, socket="albedo"):
    """(factor, texels (h, w, 3))"""
    texture = case["textures"][case[f"{socket}_texture"]]
    return np.array(case[socket]), np.array(texture["pixels"])[..., :3]


DECODED = RAW.copy()
DECODED[1, 1] = HALF_SRGB


@pytest.mark.parametrize("name, texels", [
    ("texture_srgb", DECODED), ("texture_file", DECODED), ("texture_packed", DECODED),
    ("texture_non_color", RAW), ("texture_float", RAW)])
def test_texture_is_linear_and_starts_at_the_bottom(cases, name, texels):
    factor, pixels = textured(cases[name])
    assert factor == approx([1, 1, 1])
    assert pixels == approx(texels, abs=BYTE)
    assert cases[name]["warnings"] == []


def test_texture_uses_the_render_uv_map(cases):
    uv = np.array(cases["texture_srgb"]["uv"])
    corners = {tuple(corner) for triangle in uv for corner in triangle}
    assert corners == {(0, 0), (1, 0), (1, 1), (0, 1)}


def test_constant_stays_beside_the_texture(cases):
    factor, pixels = textured(cases["texture_times_constant"])
    assert factor == approx([0.5, 0.25, 1.0])
    assert pixels == approx(RAW, abs=BYTE)


def test_sum_of_texture_and_constant_is_baked(cases):
    factor, pixels = textured(cases["texture_mixed_with_constant"])
    assert pixels * factor == approx(0.5 * RAW + 0.5, abs=BYTE)


def test_texture_as_mix_factor(cases):
    """A factor is a number: a colour that is linked to one counts as its luminance."""
    case = cases["texture_as_mix_factor"]
    factor, pixels = textured(case, "emission")
    grey = RAW @ np.array([0.2126, 0.7152, 0.0722])
    assert pixels * factor == approx(2 * np.repeat(grey[..., None], 3, axis=-1), abs=2 * BYTE)


def test_texture_as_emission(cases):
    case = cases["texture_as_emission"]
    factor, pixels = textured(case, "emission")
    assert pixels * factor == approx(5 * RAW, abs=5 * BYTE)
    assert case["albedo"] == BLACK


def test_alpha_of_a_texture_darkens_as_in_cycles(cases):
    factor, pixels = textured(cases["texture_with_alpha"])
    assert pixels * factor == approx(0.5, abs=BYTE)


def test_missing_file(cases):
    case = cases["texture_missing"]
    (texture,) = case["textures"]
    assert texture["missing"].endswith("Gone.png")
    assert case["albedo_texture"] == 0


def test_named_uv_map(cases):
    assert np.array(cases["texture_of_second_uv_map"]["uv"]) == approx(
        np.broadcast_to([0.125, 0.25], (2, 3, 2)))


def test_unknown_uv_map_reads_one_point_and_says_so(cases):
    case = cases["texture_of_unknown_uv_map"]
    assert not np.any(case["uv"])
    (warning,) = case["warnings"]
    assert "Object 'Quad'" in warning and "'Lost'" in warning


def test_mapping_node(cases):
    """Scale, then rotate by 90 degrees, then move: (u, v) -> (-3 v + .5, 2 u + .25)."""
    plain = np.array(cases["texture_srgb"]["uv"])
    mapped = np.array(cases["texture_through_mapping"]["uv"])
    expected = np.stack([-3 * plain[..., 1] + 0.5, 2 * plain[..., 0] + 0.25], axis=-1)
    assert mapped == approx(expected, abs=1e-5)


def test_second_set_of_coordinates_is_averaged(cases):
    case = cases["emission_with_other_coordinates"]
    assert case["emission_texture"] == -1
    assert case["emission"] == approx(RAW.mean(axis=(0, 1)), abs=BYTE)
    (warning,) = case["warnings"]
    assert "average" in warning


def test_an_image_is_added_once(cases):
    assert cases["shared"] == {"textures": 1, "materials": 2}
