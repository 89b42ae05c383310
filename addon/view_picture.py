# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of the core on the graphics card, as a 3D viewport shows it."""
import gpu
import numpy as np
from gpu_extras.presets import draw_texture_2d


class ViewPicture:
    """Made and drawn in view_draw() only, where Blender's context is current."""

    def __init__(self, picture: dict):
        """picture: of LiveView.picture()"""
        self.quality = picture["quality"]
        self.solution = picture["solution"]
        self._border = picture["border"]
        height, width, _ = picture["combined"].shape
        # Half floats hold what an eye can tell apart; what exceeds them would become infinite.
        pixels = np.minimum(picture["combined"], np.finfo(np.float16).max, dtype=np.float32)
        self._texture = gpu.types.GPUTexture(
            (width, height), format="RGBA16F",
            data=gpu.types.Buffer("FLOAT", pixels.size, pixels.reshape(-1)))

    def draw(self, engine, scene):
        """Over its border, in scene-linear colours: Blender's view transform comes after."""
        x0, y0, x1, y1 = self._border
        blend = gpu.state.blend_get()
        gpu.state.blend_set("ALPHA_PREMULT")
        engine.bind_display_space_shader(scene)
        draw_texture_2d(self._texture, (x0, y0), x1 - x0, y1 - y0)
        engine.unbind_display_space_shader()
        gpu.state.blend_set(blend)
