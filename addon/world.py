# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's world -> the background that the camera sees. It lights nothing yet."""
import numpy as np

from . import compat
from .colour import Colour, Mapping, Texture, UnsupportedShading, constant, multiply
from .images import open_image, read_pixels
from .nodes import Place, Walk, colour, source


def latitude_mean(pixels: np.ndarray) -> np.ndarray:
    """(h, w, 4) equirectangular -> (3,) mean over the sphere: rows weigh as their solid angle."""
    rows = (np.arange(pixels.shape[0]) + 0.5) / pixels.shape[0]
    weights = np.sin(np.pi * rows)
    return (pixels[..., :3].mean(axis=1) * weights[:, None]).sum(axis=0) / weights.sum()


def environment_mean(node, note, read) -> Colour:
    if node.image is None:
        raise UnsupportedShading(f"the environment texture '{node.name}' has no image")
    texture: Texture = open_image(node, Mapping(), note, read)
    if texture.missing_path is not None:
        raise UnsupportedShading(f"the image '{texture.name}' cannot be read from "
                                 f"{texture.missing_path}")
    note(f"the average of the environment texture '{node.name}' fills the background")
    return constant(latitude_mean(texture.pixels()))


def background(world, note, read) -> Colour:
    if not compat.uses_nodes(world):
        return constant(world.color)
    output = compat.output_node(world.node_tree)
    at, socket = (None, None) if output is None else source(Place(output.inputs["Surface"]))
    if socket is None:
        return constant(0.0)
    node = at.socket
    if node.type != "BACKGROUND":
        raise UnsupportedShading(f"the node '{node.name}' is not a Background")

    def no_image(image_node, mapping):
        raise UnsupportedShading(f"the image texture '{image_node.name}' cannot be projected")

    walk = Walk(no_image)
    strength = colour(Place(node.inputs["Strength"], at.groups), walk)
    above, above_socket = source(Place(node.inputs["Color"], at.groups))
    if above_socket is not None and above.socket.type == "TEX_ENVIRONMENT":
        return multiply(environment_mean(above.socket, note, read), strength)
    return multiply(colour(Place(node.inputs["Color"], at.groups), walk), strength)


def set_background(scene, world, warn, read=read_pixels):
    """`scene`: the core's; `world`: Blender's or None, which is black; `read`: of images, as
    read_pixels()."""
    if world is None:
        scene.set_background((0.0, 0.0, 0.0))
        return

    def note(text):
        warn(f"World '{world.name}': {text}")

    try:
        radiance = background(world, note, read).factor
    except UnsupportedShading as reason:
        radiance = tuple(world.color)
        note(f"its viewport colour fills the background, because {reason}")
    if any(radiance):
        note("it fills the background but does not light the scene yet; for light add a lamp or "
             "an emitting mesh, or set its strength to 0 to silence this")
    scene.set_background(radiance)
