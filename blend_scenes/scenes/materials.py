# SPDX-License-Identifier: GPL-3.0-or-later
"""The paints, woods, fabrics and metals that the furnished scenes share, all of them diffuse."""

from . import kit

# Name: (shader, sRGB code as a paint chart gives it).  Both shaders that the renderer reads occur.
CHART = {
    "White paint": ("diffuse", "e9e6df"),
    "Warm wall": ("principled", "e3d9c8"),
    "Cool wall": ("diffuse", "d5dbdc"),
    "Sage wall": ("diffuse", "a9b8a0"),
    "Ceiling white": ("diffuse", "f0efec"),
    "Lacquer white": ("principled", "e8e8e6"),
    "Carpet": ("diffuse", "7d8388"),
    "Carpet blue": ("diffuse", "56697f"),
    "Linoleum": ("principled", "b3a88f"),
    "Parquet": ("principled", "b48a5c"),
    "Oak": ("principled", "c09762"),
    "Beech": ("diffuse", "d3b083"),
    "Walnut": ("principled", "6e4a2f"),
    "Black plastic": ("principled", "2a2a2c"),
    "Grey plastic": ("diffuse", "8a8c8f"),
    "Light plastic": ("diffuse", "c9cac8"),
    "Steel": ("principled", "a3a6a8"),
    "Dark steel": ("diffuse", "4a4d50"),
    "Chair blue": ("diffuse", "2f4d73"),
    "Chair red": ("diffuse", "93392f"),
    "Screen fabric": ("diffuse", "7f9aa6"),
    "Paper": ("diffuse", "efece2"),
    "Cardboard": ("diffuse", "b08d60"),
    "Leaf": ("diffuse", "4e7a37"),
    "Soil": ("diffuse", "3d2c20"),
    "Terracotta": ("principled", "b5673f"),
    "Porcelain": ("principled", "ebe7de"),
    "Mustard": ("diffuse", "d3a02c"),
    "Brick red": ("principled", "a8402c"),
    "Tatami": ("diffuse", "b9ae74"),
    "Tatami border": ("diffuse", "3c4a3a"),
    "Clay plaster": ("diffuse", "d8c9a4"),
    "Cedar": ("principled", "a9794c"),
    "Cedar board": ("diffuse", "c8a274"),
    "Shoji paper": ("diffuse", "efe9da"),
    "Indigo": ("diffuse", "33456f"),
    "Celadon": ("principled", "9db8a0"),
    "Book red": ("diffuse", "9c2f2a"),
    "Book green": ("diffuse", "3f6b4a"),
    "Book blue": ("diffuse", "34507f"),
    "Book ochre": ("diffuse", "c5933c"),
    "Book cream": ("diffuse", "ddd2b8"),
    "Book grey": ("principled", "6a6d72"),
    "Book violet": ("diffuse", "6b4a70"),
    "Book teal": ("principled", "2f6f73"),
}
BOOKS = [name for name in CHART if name.startswith("Book ")]


class Palette:
    """Makes the materials of one scene when they are first asked for: palette["Oak"]."""

    def __init__(self):
        self._made = {}

    def __getitem__(self, name):
        if name not in self._made:
            shader, code = CHART[name]
            make = {"diffuse": kit.diffuse, "principled": kit.principled}[shader]
            self._made[name] = make(name, kit.srgb(code))
        return self._made[name]

    def books(self):
        return [self[name] for name in BOOKS]
