# SPDX-License-Identifier: GPL-3.0-or-later
"""Multilayer OpenEXR files as Blender writes them."""

import numpy as np


def read_multilayer(path):
    """{"Combined": (h, w, 4), "Depth": (h, w), "Normal": (h, w, 3)}, row 0 at the top.

    Each pass also stands under "Layer.Pass"; the short name is the first layer's. Of a stereo
    picture the names are "Layer.Pass.view".
    """
    import OpenImageIO as oiio

    image = oiio.ImageBuf(str(path))
    assert not image.has_error, f"{path}: {image.geterror()}"
    spec = image.spec()
    pixels = np.asarray(image.get_pixels(oiio.FLOAT)).reshape(spec.height, spec.width, -1)
    channels = {}
    for index, name in enumerate(spec.channelnames):
        whole_pass, channel = name.rsplit(".", 1)
        channels.setdefault(whole_pass, {})[channel] = pixels[:, :, index]
    passes = {}
    for name, parts in channels.items():
        order = [c for c in "RGBAXYZV" if c in parts]
        stack = np.stack([parts[c] for c in order], axis=-1)
        passes[name] = stack[..., 0] if len(order) == 1 else stack
        passes.setdefault(name.split(".", 1)[1], passes[name])
    return passes
