# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials of a render: each one is translated once and added to the scene once."""
from dataclasses import dataclass

from . import compat
from .colour import BLACK, Colour, Mapping, UnsupportedShading, constant
from .images import open_image, read_pixels
from .nodes import Place, Surface, Walk, surface

DEFAULT_ALBEDO = 0.8  # Blender's surface without a material


@dataclass(frozen=True)
class SceneMaterial:
    index: int               # in the scene
    name: str
    mapping: Mapping | None  # where its textures are looked up; None: it has none


def translate(material, note, read=read_pixels) -> Surface:
    """The surface of a material; `note(text)` gets what was left out, and why if it fell back.
    read: of images, as read_pixels()."""
    if material is None:
        return Surface(albedo=constant(DEFAULT_ALBEDO))
    viewport = Surface(albedo=constant(material.diffuse_color))
    if not compat.uses_nodes(material):
        return viewport
    output = compat.output_node(material.node_tree)
    if output is None:
        note("it has no Material Output node, it is rendered black")
        return Surface()
    walk = Walk(lambda node, mapping: open_image(node, mapping, note, read))
    try:
        result = surface(Place(output.inputs["Surface"]), walk)
    except UnsupportedShading as reason:
        note(f"it is rendered in its viewport colour, because {reason}")
        return viewport
    if output.inputs["Displacement"].is_linked:
        walk.note("its displacement is left out")
    if output.inputs["Volume"].is_linked:
        walk.note("its volume is left out")
    for text in walk.notes:
        note(text)
    return result


def average(colour: Colour) -> Colour:
    return constant(colour.texels().mean(axis=(0, 1)))


class MaterialTable:
    """Adds materials and textures to `scene` (the native one) as they are met."""

    def __init__(self, scene, warn, read=read_pixels):
        self._scene = scene
        self._warn = warn
        self._read = read
        self._materials = {}  # key of the material -> SceneMaterial
        self._textures = {}   # Texture.key -> index in the scene

    def add(self, material) -> SceneMaterial:
        key = None if material is None else material.name_full
        if key not in self._materials:
            self._materials[key] = self._translate(material)
        return self._materials[key]

    def _translate(self, material) -> SceneMaterial:
        name = "(no material)" if material is None else material.name_full
        seen = set()

        def note(text):
            if text not in seen:
                seen.add(text)
                self._warn(f"Material '{name}': {text}")

        result = translate(material, note, self._read)
        albedo, emission = result.albedo, result.emission
        used = [colour.texture for colour in (albedo, emission) if colour.texture is not None]
        if len(used) == 2 and used[0].mapping != used[1].mapping:
            note("its emission uses the average of its texture, because the texture coordinates "
                 "differ from the base colour's")
            emission = average(emission) if used[1].missing_path is None else BLACK
        index = self._scene.add_material(
            name, albedo=albedo.factor, emission=emission.factor,
            albedo_texture=self._texture(albedo), emission_texture=self._texture(emission))
        return SceneMaterial(index, name, used[0].mapping if used else None)

    def _texture(self, colour: Colour) -> int:
        texture = colour.texture
        if texture is None:
            return -1
        if texture.key not in self._textures:
            if texture.missing_path is not None:
                index = self._scene.add_missing_texture(texture.name, texture.missing_path)
            else:
                index = self._scene.add_texture(texture.name, texture.pixels())
            self._textures[texture.key] = index
        return self._textures[texture.key]
