# SPDX-License-Identifier: GPL-3.0-or-later
"""Shader nodes -> diffuse albedo and emission. Duck-typed on Blender's nodes, no bpy in here.

What has a place in a diffuse world: Principled (base colour, emission), Diffuse, Emission, and Mix
and Add Shader of these. A part that has none raises UnsupportedShading; a part that can be left
out without changing the character of the surface is left out with a note.
"""
from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from .colour import (BLACK, Colour, Mapping, Texture, UnsupportedShading, WHITE, add, apply,
                     constant, mix, multiply)

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])  # of linear Rec.709

# Input names of the Principled BSDF: Blender 4 and later first, then 3.x.
EMISSION_COLOUR = ("Emission Color", "Emission")
TRANSMISSION = ("Transmission Weight", "Transmission")
LEFT_OUT = {  # inputs that are left out with a note when they are not 0
    "subsurface scattering": ("Subsurface Weight", "Subsurface"),
    "the coat": ("Coat Weight", "Clearcoat"),
    "the sheen": ("Sheen Weight", "Sheen"),
}


@dataclass(frozen=True)
class Surface:
    albedo: Colour = BLACK    # diffuse reflectance, 0..1
    emission: Colour = BLACK  # radiance, W/(m2 sr)


@dataclass
class Walk:
    """One evaluation: how to open an image, and the notes gathered on the way."""
    open_image: Callable[[object, Mapping], Texture]  # (Image Texture node, mapping) -> texture
    notes: list[str] = field(default_factory=list)

    def note(self, text: str):
        if text not in self.notes:
            self.notes.append(text)


@dataclass(frozen=True)
class Place:
    """An input socket and the group nodes that lead to it, outermost first."""
    socket: object
    groups: tuple = ()


def input_named(node, *names):
    """The first input that exists; sockets were renamed between Blender versions."""
    return next((node.inputs[name] for name in names if name in node.inputs), None)


def source(place: Place):
    """(place, None) for an unlinked input, with the place that holds its value, else
    (place of the node, output socket). Looks through reroutes, muted nodes and groups."""
    socket, groups = place.socket, place.groups
    while True:
        link = next((link for link in socket.links if link.is_valid and not link.is_muted), None)
        if link is None:
            return Place(socket, groups), None
        node, output = link.from_node, link.from_socket
        if node.type == "REROUTE":
            socket = node.inputs[0]
        elif node.mute:
            through = next((inner.from_socket for inner in node.internal_links
                            if inner.to_socket == output), None)
            if through is None:
                raise UnsupportedShading(f"the muted node '{node.name}' passes nothing on")
            socket = through
        elif node.type == "GROUP":
            groups += (node,)
            socket = group_output(node, output)
        elif node.type == "GROUP_INPUT":
            socket = by_identifier(groups[-1].inputs, output)
            groups = groups[:-1]
        else:
            return Place(node, groups), output


def by_identifier(sockets, wanted):
    return next(socket for socket in sockets if socket.identifier == wanted.identifier)


def group_output(group, output):
    ends = [] if group.node_tree is None else [
        node for node in group.node_tree.nodes if node.type == "GROUP_OUTPUT"]
    end = next((node for node in ends if node.is_active_output), None)
    if end is None:
        raise UnsupportedShading(f"the node group '{group.name}' has no output")
    return by_identifier(end.inputs, output)


# --- surfaces -------------------------------------------------------------------------------------

def surface(place: Place, walk: Walk) -> Surface:
    at, output = source(place)
    if output is None:
        return Surface()  # no shader reflects and emits nothing, as in Cycles
    shader = SHADERS.get(at.socket.type)
    if shader is None:
        raise UnsupportedShading(f"the node '{at.socket.name}' ({at.socket.bl_label}) is neither "
                                 "diffuse nor emitting")
    return shader(at.socket, at.groups, walk)


def principled(node, groups, walk):
    def of(*names):
        socket = input_named(node, *names)
        return None if socket is None else Place(socket, groups)

    require_zero(of("Metallic"), walk, "it is metallic")
    require_zero(of(*TRANSMISSION), walk, "it transmits light")
    for what, names in LEFT_OUT.items():
        if not is_zero(of(*names), walk):
            walk.note(f"{what} is left out")
    if not is_one(of("Alpha"), walk):
        walk.note("its transparency is left out, it is rendered opaque")
    note_bump(node, walk)
    strength = colour(of("Emission Strength"), walk)
    emission = BLACK if strength.is_black else multiply(
        colour(of(*EMISSION_COLOUR), walk), strength)
    return Surface(colour(of("Base Color"), walk), emission)


def diffuse(node, groups, walk):
    if not is_zero(Place(node.inputs["Roughness"], groups), walk):
        walk.note("the roughness of its Diffuse BSDF is left out")
    note_bump(node, walk)
    return Surface(albedo=colour(Place(node.inputs["Color"], groups), walk))


def emission(node, groups, walk):
    strength = colour(Place(node.inputs["Strength"], groups), walk)
    if strength.is_black:
        return Surface()
    return Surface(emission=multiply(colour(Place(node.inputs["Color"], groups), walk), strength))


def mix_shader(node, groups, walk):
    factor = clamped(colour(Place(node.inputs[0], groups), walk))
    # A branch that does not show may hold anything, so it is not even looked at.
    if factor == BLACK:
        return surface(Place(node.inputs[1], groups), walk)
    if factor == WHITE:
        return surface(Place(node.inputs[2], groups), walk)
    a = surface(Place(node.inputs[1], groups), walk)
    b = surface(Place(node.inputs[2], groups), walk)
    return Surface(mix(factor, a.albedo, b.albedo), mix(factor, a.emission, b.emission))


def add_shader(node, groups, walk):
    a = surface(Place(node.inputs[0], groups), walk)
    b = surface(Place(node.inputs[1], groups), walk)
    return Surface(add(a.albedo, b.albedo), add(a.emission, b.emission))


SHADERS = {
    "BSDF_PRINCIPLED": principled,
    "BSDF_DIFFUSE": diffuse,
    "EMISSION": emission,
    "MIX_SHADER": mix_shader,
    "ADD_SHADER": add_shader,
}


def is_zero(place, walk) -> bool:
    return place is None or quick_value(place) == 0.0


def is_one(place, walk) -> bool:
    return place is None or quick_value(place) == 1.0


def quick_value(place):
    """The number at an unlinked input, None where a node decides."""
    at, output = source(place)
    return float(at.socket.default_value) if output is None else None


def require_zero(place, walk, reason):
    if not is_zero(place, walk):
        raise UnsupportedShading(reason)


def note_bump(node, walk):
    if "Normal" in node.inputs and node.inputs["Normal"].is_linked:
        walk.note("its normal or bump map is left out")


# --- colours --------------------------------------------------------------------------------------

def colour(place: Place, walk: Walk) -> Colour:
    """Colour or number that arrives at an input; numbers become grey."""
    at, output = source(place)
    if output is None:
        return constant(at.socket.default_value)
    node = COLOURS.get(at.socket.type)
    if node is None:
        raise UnsupportedShading(f"the node '{at.socket.name}' ({at.socket.bl_label}) cannot be "
                                 "evaluated, only image textures and constants can")
    result = node(at.socket, output, at.groups, walk)
    return grey(result) if place.socket.type == "VALUE" and output.type == "RGBA" else result


def grey(value: Colour) -> Colour:
    """What a colour becomes where it is linked to a number."""
    return apply("grey", lambda texels: np.repeat((texels @ LUMINANCE)[..., None], 3, axis=-1), value)


def value_node(node, output, groups, walk):
    return constant(output.default_value)


def image_node(node, output, groups, walk):
    if output.name != "Color":
        raise UnsupportedShading(f"it uses the {output.name} of the image texture '{node.name}'")
    if node.image is None:
        return BLACK  # as Cycles does for an Image Texture without an image
    if node.projection != "FLAT":
        raise UnsupportedShading(f"the image texture '{node.name}' is not projected flat")
    if node.extension not in {"REPEAT", "EXTEND"}:
        walk.note(f"the image texture '{node.name}' repeats instead of {node.extension.lower()}")
    return Colour((1.0, 1.0, 1.0),
                  walk.open_image(node, mapping(Place(node.inputs["Vector"], groups), walk)))


def mix_rgb(node, output, groups, walk):
    return blend(node, *(Place(node.inputs[i], groups) for i in range(3)), node.use_clamp, walk)


def mix_node(node, output, groups, walk):
    if node.data_type == "VECTOR" or (node.data_type == "RGBA" and node.factor_mode != "UNIFORM"):
        raise UnsupportedShading(f"the node '{node.name}' mixes vectors")
    # The node keeps sockets of all its types; the enabled ones are factor, A, B.
    factor, a, b = (Place(socket, groups) for socket in node.inputs if socket.enabled)
    if node.data_type == "FLOAT":
        return mix(clamped(colour(factor, walk)) if node.clamp_factor else colour(factor, walk),
                   colour(a, walk), colour(b, walk))
    return blend(node, factor, a, b, node.clamp_result, walk)


def blend(node, factor, a, b, clamp, walk):
    modes = {"MIX": lambda x, y: y, "MULTIPLY": multiply, "ADD": add}
    if node.blend_type not in modes:
        raise UnsupportedShading(f"the node '{node.name}' blends by {node.blend_type.lower()}, "
                                 "only mix, multiply and add can be evaluated")
    weight = clamped(colour(factor, walk))
    if weight == BLACK:
        result = colour(a, walk)
    else:
        first = BLACK if weight == WHITE and node.blend_type == "MIX" else colour(a, walk)
        result = mix(weight, first, modes[node.blend_type](first, colour(b, walk)))
    return clamped(result) if clamp else result


MATH = {
    "ADD": np.add, "SUBTRACT": np.subtract, "MULTIPLY": np.multiply,
    "DIVIDE": lambda x, y: np.divide(x, y, out=np.zeros_like(x), where=y != 0),
    "POWER": np.power, "MINIMUM": np.minimum, "MAXIMUM": np.maximum,
}


def math_node(node, output, groups, walk):
    function = MATH.get(node.operation)
    operands = [colour(Place(node.inputs[i], groups), walk) for i in range(2)]
    if function is None or any(operand.texture is not None for operand in operands):
        raise UnsupportedShading(f"the node '{node.name}' (Math) cannot be evaluated")
    result = constant(float(function(*(np.float64(operand.factor[0]) for operand in operands))))
    return clamped(result) if node.use_clamp else result


def gamma_node(node, output, groups, walk):
    exponent = quick_value(Place(node.inputs["Gamma"], groups))
    if exponent is None:
        raise UnsupportedShading(f"the exponent of the node '{node.name}' is not constant")
    return apply(f"gamma {exponent}", lambda texels: np.power(np.maximum(texels, 0.0), exponent),
                 colour(Place(node.inputs["Color"], groups), walk))


def invert_node(node, output, groups, walk):
    base = colour(Place(node.inputs["Color"], groups), walk)
    inverse = apply("one minus", lambda texels: 1.0 - texels, base)
    return mix(clamped(colour(Place(input_named(node, "Fac", "Factor"), groups), walk)), base, inverse)


COLOURS = {
    "RGB": value_node,
    "VALUE": value_node,
    "TEX_IMAGE": image_node,
    "MIX_RGB": mix_rgb,
    "MIX": mix_node,
    "MATH": math_node,
    "GAMMA": gamma_node,
    "INVERT": invert_node,
}


def clamped(value: Colour) -> Colour:
    return apply("clamp", lambda texels: np.clip(texels, 0.0, 1.0), value)


# --- texture coordinates --------------------------------------------------------------------------

def mapping(place: Place, walk: Walk) -> Mapping:
    at, output = source(place)
    if output is None:
        return Mapping()
    node = at.socket
    if node.type == "UVMAP" and not node.from_instancer:
        return Mapping(node.uv_map)
    if node.type == "TEX_COORD" and output.name == "UV" and not node.from_instancer:
        return Mapping()
    if node.type == "MAPPING":
        inner = mapping(Place(node.inputs["Vector"], at.groups), walk)
        return Mapping(inner.uv_map, compose(mapping_matrix(node, at.groups), inner.matrix))
    raise UnsupportedShading("its texture coordinates do not come from a UV map "
                             f"(node '{node.name}', {output.name})")


def mapping_matrix(node, groups) -> np.ndarray:
    """The (3, 3) affine action of a Mapping node on (u, v, 1); the texture lies in z = 0."""
    def vector(name):
        at, output = source(Place(node.inputs[name], groups))
        if output is not None:
            raise UnsupportedShading(f"the {name} of the node '{node.name}' is not constant")
        return np.asarray(at.socket.default_value[:], float)

    linear = rotation_xyz(vector("Rotation")) @ np.diag(vector("Scale"))
    shift = vector("Location") if "Location" in node.inputs and node.vector_type in {
        "POINT", "TEXTURE"} else np.zeros(3)
    if node.vector_type == "TEXTURE":  # the inverse: texture moved instead of coordinates
        if abs(np.linalg.det(linear)) < 1e-12:
            raise UnsupportedShading(f"the node '{node.name}' has a scale of 0")
        linear = np.linalg.inv(linear)
        shift = -linear @ shift
    elif node.vector_type == "NORMAL":
        raise UnsupportedShading(f"the node '{node.name}' maps normals")
    return np.array([[linear[0, 0], linear[0, 1], shift[0]],
                     [linear[1, 0], linear[1, 1], shift[1]], [0.0, 0.0, 1.0]])


def rotation_xyz(angles) -> np.ndarray:
    """Blender's Euler XYZ: about X first, then Y, then Z (radians)."""
    (cx, cy, cz), (sx, sy, sz) = ([f(a) for a in angles] for f in (math.cos, math.sin))
    about_x = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_z = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


def compose(outer: np.ndarray, inner) -> tuple:
    rows = outer[:2] @ np.vstack([np.asarray(inner, float), [0.0, 0.0, 1.0]])
    return tuple(tuple(float(entry) for entry in row) for row in rows)
