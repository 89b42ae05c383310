# SPDX-License-Identifier: GPL-3.0-or-later
"""Icons of one colour, for legends."""
import bpy
import bpy.utils.previews
import numpy as np

SIZE = 32           # px
FRAME, GREY = 2, 0.4

_icons = None       # Blender's collection, made when the first one is asked for


def swatch(rgb) -> int:
    """The icon_value of a colour as the screen shows it, 0..1 each."""
    global _icons
    if _icons is None:
        _icons = bpy.utils.previews.new()
    name = str(tuple(round(float(channel), 3) for channel in rgb))
    if name not in _icons:
        pixels = np.full((SIZE, SIZE, 4), (GREY, GREY, GREY, 1.0))
        pixels[FRAME:-FRAME, FRAME:-FRAME, :3] = rgb
        icon = _icons.new(name)
        icon.icon_size = SIZE, SIZE
        icon.icon_pixels_float = pixels.ravel().tolist()
    return _icons[name].icon_id


def unregister():
    global _icons
    if _icons is not None:
        bpy.utils.previews.remove(_icons)
        _icons = None
