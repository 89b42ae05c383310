# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of the core on the graphics card, as a 3D viewport shows it."""
import gpu
import numpy as np
from gpu_extras.presets import draw_texture_2d
from mathutils import Matrix


class ViewPicture:
    """Made and drawn in view_draw() only, where Blender's context is current."""

    def __init__(self, picture: dict):
        """picture: of LiveView.picture(), which is used up"""
        self.quality = picture["quality"]
        self.solution = picture["solution"]
        self.border = picture["border"]
        pixels = picture["combined"]
        height, width, _ = pixels.shape
        # Half floats hold what an eye can tell apart; what exceeds them would become infinite.
        np.minimum(pixels, np.finfo(np.float16).max, out=pixels)
        self._texture = gpu.types.GPUTexture(
            (width, height), format="RGBA16F",
            data=gpu.types.Buffer("FLOAT", pixels.size, pixels.reshape(-1)))

    def draw(self, engine, scene):
        """Over its border, in scene-linear colours: Blender's view transform comes after."""
        x0, y0, x1, y1 = self.border
        blend = gpu.state.blend_get()
        gpu.state.blend_set("ALPHA_PREMULT")
        engine.bind_display_space_shader(scene)
        with gpu.matrix.push_pop(), gpu.matrix.push_pop_projection():
            gpu.matrix.load_identity()
            gpu.matrix.load_projection_matrix(pixel_space(*gpu.state.viewport_get()[2:]))
            draw_texture_2d(self._texture, (x0, y0), x1 - x0, y1 - y0)
        engine.unbind_display_space_shader()
        gpu.state.blend_set(blend)


def pixel_space(width, height) -> Matrix:
    """Of a region. Blender's own is 1/100 of a pixel off, which a linear filter shows."""
    return Matrix(((2 / width, 0, 0, -1), (0, 2 / height, 0, -1), (0, 0, -1, 0), (0, 0, 0, 1)))
