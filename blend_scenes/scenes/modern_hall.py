# SPDX-License-Identifier: GPL-3.0-or-later
"""Modern Hall from its Mitsuba description: every material made diffuse, its lights area lamps.

A model that nobody here made: 30,911 triangles, of which 25,920 are five lamp rings 27 cm wide and
2,371 have no area; parts that interpenetrate; vertices that no two faces share.  It is taken as it
is.  The description is Mitsuba 3's XML (transforms that map to Y up; radiance of lights in
W/(m2 sr); disk of radius 1 and rectangle of edge 2 before their transform).
"""

import math
import re
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import bpy
from mathutils import Matrix, Vector

from . import kit

CREDIT = """"Modern Hall" by NewSee2l035, CC-BY 3.0
https://creativecommons.org/licenses/by/3.0/
Original: http://www.blendswap.com/blends/view/51997
Mitsuba version: https://benedikt-bitterli.me/resources/
Changed for ANTIRADIANCE: all materials made diffuse, textures made smaller."""

PIXELS = 400  # the description's picture is square
TEXTURE_PIXELS = 256  # longest edge
Y_UP_TO_Z_UP = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))
# Diffuse stand-in for the table's glass, whose description has no reflectance of its own.
GLASS = (0.5, 0.55, 0.52)


def build(source):
    """Reads source/scene.xml and the files that it names."""
    scene = kit.new_scene(PIXELS, PIXELS)
    description = ElementTree.parse(source / "scene.xml").getroot()
    materials = {
        bsdf.get("id"): _material(bsdf, source) for bsdf in description.findall("bsdf")
    }
    lamps = 0
    for shape in description.findall("shape"):
        if shape.get("type") == "obj":
            _mesh(shape, source, materials)
        else:
            lamps += 1
            _lamp(shape, f"Lamp {lamps:02}")
    _camera(description.find("sensor"))
    scene["credit"] = CREDIT.splitlines()[0]
    scene["licence"] = CREDIT.splitlines()[1]
    bpy.data.texts.new("Credit").from_string(CREDIT)


def _value(element, name):
    """The text of the child property `name`, or None."""
    for child in element:
        if child.get("name") == name:
            return child.get("value")
    return None


def _colour(element, name):
    return tuple(float(number) for number in re.split(r"[,\s]+", _value(element, name)))


def _to_world(element):
    """The element's transform, with Z up."""
    numbers = [float(n) for n in element.find("transform/matrix").get("value").split()]
    return Y_UP_TO_Z_UP @ Matrix([numbers[row : row + 4] for row in range(0, 16, 4)])


# -------------------------------------------------------------------------------------- materials


def _material(bsdf, source):
    name = bsdf.get("id").removesuffix("BSDF")
    while bsdf.get("type") == "twosided":
        bsdf = bsdf.find("bsdf")
    texture = bsdf.find("texture")
    if texture is not None:
        return _textured(name, source / _value(texture, "filename"))
    if bsdf.get("type") == "roughconductor":
        return kit.diffuse(name, _conductor_reflectance(bsdf))
    if bsdf.get("type") == "dielectric":
        return kit.diffuse(name, GLASS)
    return kit.diffuse(name, _colour(bsdf, "reflectance"))


def _conductor_reflectance(bsdf):
    """Fresnel's reflectance at normal incidence, from the complex index of refraction."""
    return tuple(
        ((n - 1) ** 2 + k**2) / ((n + 1) ** 2 + k**2)
        for n, k in zip(_colour(bsdf, "eta"), _colour(bsdf, "k"))
    )


def _textured(name, path):
    material = kit.diffuse(name, (0.8, 0.8, 0.8))
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = next(node for node in nodes if node.bl_idname == "ShaderNodeBsdfDiffuse")
    texture = nodes.new("ShaderNodeTexImage")
    texture.location.x = shader.location.x - 300.0
    texture.image = _small_image(path)
    links.new(texture.outputs["Color"], shader.inputs["Color"])
    return material


def _small_image(path):
    """The picture, scaled down and packed."""
    image = bpy.data.images.load(str(path))
    scale = min(1.0, TEXTURE_PIXELS / max(image.size))
    image.scale(*(max(1, round(edge * scale)) for edge in image.size))
    with tempfile.TemporaryDirectory() as folder:
        image.filepath_raw = str(Path(folder) / path.name)
        image.file_format = "JPEG"
        image.save()  # packs nothing but files
        image.source = "FILE"
        image.pack()
    image.filepath_raw = f"//{path.name}"  # of no machine
    return image


# ------------------------------------------------------------------------ meshes, lamps, camera


def _mesh(shape, source, materials):
    before = set(bpy.data.objects)
    bpy.ops.wm.obj_import(filepath=str(source / _value(shape, "filename")))
    (thing,) = set(bpy.data.objects) - before
    thing.name = thing.data.name = shape.get("id")
    thing.matrix_world = _to_world(shape) @ Y_UP_TO_Z_UP.inverted() @ thing.matrix_world
    material = materials[shape.find("ref").get("id")]
    thing.data.materials.clear()
    thing.data.materials.append(material)
    if not any(node.bl_idname == "ShaderNodeTexImage" for node in material.node_tree.nodes):
        thing.data.uv_layers.remove(thing.data.uv_layers[0])  # a third of the file
    if _value(shape, "face_normals") == "true":
        _forget_normals(thing.data)


def _forget_normals(mesh):
    """Flat faces in place of the file's normals."""
    mesh.normals_split_custom_set([(0.0, 0.0, 0.0)] * len(mesh.loops))
    mesh.polygons.foreach_set("use_smooth", [False] * len(mesh.polygons))


def _lamp(shape, name):
    """An area lamp that shines along the shape's +Z; Blender's along its -Z."""
    to_world = _to_world(shape)
    x, y, z = (to_world.col[axis].to_3d() for axis in range(3))
    radiance = _colour(shape.find("emitter"), "radiance")
    data = bpy.data.lights.new(name, "AREA")
    data.shape = "DISK" if shape.get("type") == "disk" else "RECTANGLE"
    data.size, data.size_y = 2.0 * x.length, 2.0 * y.length
    area = x.length * y.length * (math.pi if data.shape == "DISK" else 4.0)
    strongest = max(radiance)
    data.color = [channel / strongest for channel in radiance]
    data.energy = 4.0 * area * strongest  # Cycles: radiance = energy / (4 area)
    lamp = bpy.data.objects.new(name, data)
    x, z = x.normalized(), z.normalized()
    axes = Matrix((x, -z.cross(x), -z)).transposed()
    lamp.matrix_world = Matrix.Translation(to_world.translation) @ axes.to_4x4()
    lamp.visible_camera = True  # the windows are lamps
    bpy.context.scene.collection.objects.link(lamp)


def _camera(sensor):
    """Mitsuba's camera looks along its +Z with +Y up."""
    to_world = _to_world(sensor)
    eye = to_world.translation
    lens = 18.0 / math.tan(math.radians(float(_value(sensor, "fov")) / 2.0))  # of a 36 mm sensor
    kit.add_camera(eye, eye + Vector(to_world.col[2].to_3d()), lens)
