# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's images -> linear float pixels."""
import numpy as np

from .colour import Mapping, Texture, expand_to_rgba, srgb_to_linear

# Byte images keep their file's encoding in `pixels`; float images are already scene-linear there.
LINEAR_SPACES = {"Linear", "Linear Rec.709", "Non-Color", "Raw", "Generic Data"}


def read_pixels(image) -> np.ndarray:
    """(h, w, 4) float32, linear Rec.709, associated alpha in the colour, row 0 at the bottom."""
    width, height = image.size
    flat = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(flat)
    rgba = expand_to_rgba(flat, width, height, image.channels)
    if image.is_float:
        return rgba
    if image.colorspace_settings.name not in LINEAR_SPACES:
        rgba[..., :3] = srgb_to_linear(rgba[..., :3])
    if image.alpha_mode == "STRAIGHT":  # Cycles' Color output is associated unless Alpha is used
        rgba[..., :3] *= rgba[..., 3:]
    return rgba


def open_image(node, mapping: Mapping, note) -> Texture:
    """The texture of an Image Texture node; `note(text)` takes what could not be honoured."""
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
    return Texture(("image", image.name_full), image.name, mapping, lambda: read_pixels(image),
                   missing)
