# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's images -> linear float pixels."""
import os

import bpy
import numpy as np

from .colour import Mapping, Texture, expand_to_rgba, srgb_to_linear

# Byte images keep their file's encoding in `pixels`; float images are already scene-linear there.
LINEAR_SPACES = {"Linear", "Linear Rec.709", "Non-Color", "Raw", "Generic Data"}
LINEAR_OF_BYTE = srgb_to_linear(np.arange(256, dtype=np.float32) / np.float32(255))


def read_pixels(image) -> np.ndarray:
    """(h, w, 4) float32, linear Rec.709, associated alpha in the colour, row 0 at the bottom."""
    width, height = image.size
    flat = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(flat)
    rgba = expand_to_rgba(flat, width, height, image.channels)
    if image.is_float:
        return rgba
    if image.colorspace_settings.name not in LINEAR_SPACES:
        rgba[..., :3] = LINEAR_OF_BYTE[np.rint(rgba[..., :3] * 255).astype(np.uint8)]
    if image.alpha_mode == "STRAIGHT":  # Cycles' Color output is associated unless Alpha is used
        rgba[..., :3] *= rgba[..., 3:]
    return rgba


class ImageCache:
    """Pixels of images from one reading of the scene to the next, by name and settings."""

    # What Blender changes the pixels with, without telling its depsgraph that the image changed.
    SETTINGS = ("source", "filepath", "channels", "is_float", "alpha_mode", "generated_type",
                "generated_color")

    def __init__(self):
        self._kept = {}  # name -> (settings, pixels)

    def forget_edited(self, updates):
        """updates: of the depsgraph"""
        for update in updates:
            if isinstance(update.id, bpy.types.Image):
                self._kept.pop(update.id.name_full, None)

    def read_pixels(self, image) -> np.ndarray:
        """As read_pixels()."""
        if image.is_dirty:  # while it is painted on, nothing tells one stroke from the next
            return read_pixels(image)
        settings = self._settings(image)
        if self._kept.get(image.name_full, (None,))[0] != settings:
            self._kept[image.name_full] = settings, read_pixels(image)
        return self._kept[image.name_full][1]

    def _settings(self, image):
        try:  # a file that was written anew may have been loaded again
            written = os.stat(bpy.path.abspath(image.filepath, library=image.library)).st_mtime_ns
        except OSError:
            written = None
        return [written, tuple(image.size), image.colorspace_settings.name,
                *(comparable(getattr(image, name)) for name in self.SETTINGS)]

    def clear(self):
        self._kept.clear()


def comparable(value):
    """A value of a property, detached from Blender's data."""
    return value if isinstance(value, (str, int, float)) else tuple(value)


def open_image(node, mapping: Mapping, note, read=read_pixels) -> Texture:
    """The texture of an Image Texture node; `note(text)` takes what could not be honoured. read: as
    read_pixels()."""
    image = node.image
    if image.source == "TILED":
        note(f"only the first tile of the image '{image.name}' is used")
    elif image.source in {"SEQUENCE", "MOVIE"}:
        note(f"the image '{image.name}' does not follow the frame")
    space = image.colorspace_settings.name
    if not image.is_float and space not in LINEAR_SPACES and space != "sRGB":
        note(f"the colour space '{space}' of the image '{image.name}' is taken for sRGB")
    missing = None
    if not (image.size[0] and image.size[1]):  # asking for the size loads the file
        missing = image.filepath or "(no file name)"
    return Texture(("image", image.name_full), image.name, mapping, lambda: read(image),
                   missing)
