# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours of materials: a constant, or a constant times a texture. No bpy in here.

Combining two textures (mixes, sums, products) bakes a new one, pixel by pixel, provided that both
are looked up at the same place; the C++ core only knows constant x texture.
"""
from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field, replace

import numpy as np


class UnsupportedShading(Exception):
    """Some part of a node set-up that this engine cannot express; the text says which."""


def srgb_to_linear(encoded: np.ndarray) -> np.ndarray:
    """IEC 61966-2-1 decoding, element by element; keeps float32."""
    low = encoded / 12.92
    high = np.power((np.maximum(encoded, 0.0) + 0.055) / 1.055, 2.4)
    return np.where(encoded <= 0.04045, low, high).astype(np.float32)


def expand_to_rgba(flat: np.ndarray, width: int, height: int, channels: int) -> np.ndarray:
    """Blender's flat pixels, row 0 at the bottom -> (h, w, 4) float32. One channel becomes grey."""
    pixels = flat.reshape(height, width, channels)
    rgba = np.ones((height, width, 4), np.float32)
    if channels < 3:
        rgba[..., :3] = pixels[..., :1]
        if channels == 2:
            rgba[..., 3] = pixels[..., 1]
    else:
        rgba[..., :channels] = pixels
    return rgba


def resample(pixels: np.ndarray, height: int, width: int) -> np.ndarray:
    """Bilinear, periodic, pixel centres at half integers: (h, w, c) -> (height, width, c)."""
    if pixels.shape[:2] == (height, width):
        return pixels

    def along(axis_pixels, count):
        old = axis_pixels.shape[0]
        at = (np.arange(count) + 0.5) * old / count - 0.5
        low = np.floor(at).astype(int)
        weight = (at - low).astype(np.float32).reshape(-1, 1, 1)
        return axis_pixels[low % old] * (1 - weight) + axis_pixels[(low + 1) % old] * weight

    rows = along(pixels, height)
    return along(rows.swapaxes(0, 1), width).swapaxes(0, 1)


@dataclass(frozen=True)
class Mapping:
    """Where a texture is looked up: (u, v) -> matrix @ (u, v, 1) on the named UV map."""
    uv_map: str = ""  # "" = the mesh's active render UV map
    matrix: tuple[tuple[float, float, float], ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))

    def apply(self, uv: np.ndarray) -> np.ndarray:
        """uv (..., 2) -> (..., 2) float32"""
        if self.matrix == Mapping.matrix:
            return uv
        affine = np.asarray(self.matrix, np.float32)
        return (uv @ affine[:, :2].T + affine[:, 2]).astype(np.float32)


@dataclass(frozen=True)
class Texture:
    """`pixels()` -> (h, w, 4) float32 linear, row 0 at the bottom. Equal keys, equal pixels."""
    key: Hashable
    name: str
    mapping: Mapping
    pixels: Callable[[], np.ndarray] = field(compare=False)
    missing_path: str | None = None  # set: the image could not be loaded from there


@dataclass(frozen=True)
class Colour:
    """factor (linear RGB) x texture, or factor alone."""
    factor: tuple[float, float, float]
    texture: Texture | None = None

    @property
    def is_black(self) -> bool:
        return not any(self.factor)

    def texels(self) -> np.ndarray:
        """(h, w, 3) with the factor applied; (1, 1, 3) for a constant."""
        factor = np.asarray(self.factor, np.float32)
        if self.texture is None:
            return factor.reshape(1, 1, 3)
        return self.texture.pixels()[..., :3] * factor


BLACK = Colour((0.0, 0.0, 0.0))
WHITE = Colour((1.0, 1.0, 1.0))


def constant(value) -> Colour:
    """A number or the first three of a sequence."""
    if isinstance(value, (int, float)):
        return Colour((float(value),) * 3)
    return Colour(tuple(float(channel) for channel in value[:3]))


def multiply(a: Colour, b: Colour) -> Colour:
    if a.texture is not None and b.texture is not None:
        return combine("multiply", np.multiply, a, b)
    product = tuple(x * y for x, y in zip(a.factor, b.factor))
    return Colour(product, None if not any(product) else a.texture or b.texture)


def add(a: Colour, b: Colour) -> Colour:
    if a.is_black or b.is_black:
        return b if a.is_black else a
    if a.texture is None and b.texture is None:
        return Colour(tuple(x + y for x, y in zip(a.factor, b.factor)))
    if a.texture is not None and b.texture is not None and a.texture == b.texture:
        return replace(a, factor=tuple(x + y for x, y in zip(a.factor, b.factor)))
    return combine("add", np.add, a, b)


def mix(factor: Colour, a: Colour, b: Colour) -> Colour:
    """(1 - factor) a + factor b, channel by channel."""
    complement = apply("one minus", lambda texels: 1.0 - texels, factor)
    return add(multiply(complement, a), multiply(factor, b))


def apply(name: str, function: Callable[[np.ndarray], np.ndarray], colour: Colour) -> Colour:
    """A function of each texel. `name` with its parameters must identify the function."""
    if colour.texture is None:
        texel = function(np.asarray(colour.factor, np.float64).reshape(1, 1, 3))
        return Colour(tuple(float(channel) for channel in texel.reshape(3)))
    return baked((name, colour.factor, colour.texture.key), colour.texture,
                 lambda: function(colour.texels()))


def combine(name: str, function, a: Colour, b: Colour) -> Colour:
    textures = [colour.texture for colour in (a, b) if colour.texture is not None]
    if any(texture.mapping != textures[0].mapping for texture in textures):
        raise UnsupportedShading("it combines textures with different texture coordinates")
    missing = next((t for t in textures if t.missing_path is not None), None)
    if missing is not None:
        return Colour((1.0, 1.0, 1.0), missing)

    def texels():
        left, right = a.texels(), b.texels()
        height = max(left.shape[0], right.shape[0])
        width = max(left.shape[1], right.shape[1])
        return function(resample(left, height, width), resample(right, height, width))

    key = (name, *((c.factor, None if c.texture is None else c.texture.key) for c in (a, b)))
    return baked(key, textures[0], texels)


def baked(key: Hashable, like: Texture, texels: Callable[[], np.ndarray]) -> Colour:
    if like.missing_path is not None:
        return Colour((1.0, 1.0, 1.0), like)

    def pixels():
        rgb = texels()
        rgba = np.ones((*rgb.shape[:2], 4), np.float32)
        rgba[..., :3] = rgb
        return rgba

    return Colour((1.0, 1.0, 1.0), Texture(key, like.name, like.mapping, pixels))
