# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's lamps -> the core's.

Blender's units: point, spot and area lamps W of radiant flux, sun W/m2 on a facing surface. What
radiance follows from them, and what a scaled lamp means, is the core's business.
"""
import math

import numpy as np

from . import compat
from .colour import UnsupportedShading
from .nodes import Place, Walk, surface

AREA_SHAPES = {  # Blender's shape -> (the core's, whether size_y counts)
    "SQUARE": ("RECTANGLE", False),
    "RECTANGLE": ("RECTANGLE", True),
    "DISK": ("ELLIPSE", False),
    "ELLIPSE": ("ELLIPSE", True),
}


def shader_factor(light, warn) -> tuple[float, float, float]:
    """Colour x strength of the lamp's Emission node, which multiplies its power as in Cycles."""
    if not compat.uses_nodes(light):
        return 1.0, 1.0, 1.0
    output = compat.output_node(light.node_tree)

    def no_image(node, mapping):
        raise UnsupportedShading(f"the image texture '{node.name}' cannot be projected")

    try:
        if output is None:
            raise UnsupportedShading("they have no Light Output")
        return surface(Place(output.inputs["Surface"]), Walk(no_image)).emission.factor
    except UnsupportedShading as reason:
        warn(f"Lamp '{light.name_full}': its nodes are left out, because {reason}")
        return 1.0, 1.0, 1.0


def power(light, matrix_world, warn) -> np.ndarray:
    """(3,) colour x W, or W/m2 for a sun"""
    colour = np.asarray(light.color[:], float) * np.asarray(shader_factor(light, warn))
    return colour * light.energy * compat.lamp_scale(light, matrix_world)


def add_lamp(scene, name, lamp_object, matrix_world, warn):
    """Adds `lamp_object`, a LIGHT, at `matrix_world` to the core's `scene`."""
    light = lamp_object.data
    settings = {
        "type": light.type,
        "matrix": np.array(matrix_world, np.float32),
        "color": tuple(float(channel) for channel in power(light, matrix_world, warn)),
        "visible_to_camera": lamp_object.visible_camera,
    }
    if light.type in {"POINT", "SPOT"}:
        settings["radius"] = light.shadow_soft_size
    if light.type == "SPOT":
        settings.update(spot_angle=light.spot_size, spot_blend=light.spot_blend,
                        spot_cosine=compat.SPOT_HAS_COSINE)
    if light.type == "SUN":
        settings["sun_angle"] = light.angle
    if light.type == "AREA":
        shape, has_y = AREA_SHAPES[light.shape]
        settings.update(shape=shape, size_x=light.size,
                        size_y=light.size_y if has_y else light.size, spread=min(light.spread, math.pi))
    if not light_casts_shadow(light):
        warn(f"Lamp '{name}': it casts shadows, its Shadow setting is left out")
    scene.add_lamp(name, **settings)


def light_casts_shadow(light) -> bool:
    """Cycles' own Cast Shadow, where that add-on is enabled; EEVEE's `use_shadow` is not it."""
    cycles = getattr(light, "cycles", None)
    return getattr(cycles, "cast_shadow", True)
