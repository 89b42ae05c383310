# SPDX-License-Identifier: GPL-3.0-or-later
"""Floor 5 of Soda Hall, the paper's own building, with lamps in the ceilings of rooms and hallways.

The model ("U.C. Berkeley Soda Hall WALKTHRU Model", see the notice in its files) may not be used
commercially, so neither it nor a .blend made from it is part of this project.  1,685 quads, normals
into the air; windows are open holes; walls meet in T-junctions; there is no roof.  It has no lamps:
the paper lit it with diffuse area lights, and so does this script.
"""

import math

import bpy
from mathutils import Vector

from . import kit

CREDIT = "U.C. Berkeley Soda Hall WALKTHRU Model; not for commercial use, see the model's notice"

LAMP_LENGTH, LAMP_WIDTH = 1.2, 0.5  # m
LAMP_SPACING = 2.6  # m, at most, along both axes of a ceiling
LAMP_RADIANCE = 3.0  # W/(m2 sr)
LAMP_COLOUR = (1.0, 0.92, 0.8)
BELOW_CEILING = 0.02  # m
DARKEST, LIGHTEST = 0.05, 0.8  # albedo: the model has colours of 0 and of .94
EYE = 1.6  # m above the floor
CUT = 2.2  # m above the floor: what lies higher is not seen in the view from above


def build(source):
    """Reads source/csb5.obj."""
    scene = kit.new_scene(480, 360)
    bpy.ops.wm.obj_import(
        filepath=str(source / "csb5.obj"), forward_axis="Y", up_axis="Z", validate_meshes=False
    )
    (building,) = bpy.data.objects
    building.name = building.data.name = "Soda Hall"
    for slot in building.material_slots:
        slot.material = _diffuse(slot.material)
    _lamps(building)
    _cameras(building)
    scene["credit"] = CREDIT


def _diffuse(material):
    shader = next(n for n in material.node_tree.nodes if n.bl_idname == "ShaderNodeBsdfPrincipled")
    colour = shader.inputs["Base Color"].default_value[:3]
    return kit.diffuse(
        material.name + " diffuse", tuple(min(max(c, DARKEST), LIGHTEST) for c in colour)
    )


def _lamps(building):
    """Rectangles below every ceiling that has a floor below it and room for them."""
    data = bpy.data.lights.new("Ceiling lamp", "AREA")
    data.shape = "RECTANGLE"
    data.size, data.size_y = LAMP_LENGTH, LAMP_WIDTH
    data.color = LAMP_COLOUR
    data.energy = 4.0 * LAMP_LENGTH * LAMP_WIDTH * LAMP_RADIANCE  # Cycles: energy / (4 area)
    mesh = building.data
    for face in mesh.polygons:
        if face.normal.z > -0.99:
            continue
        corners = [mesh.vertices[i].co for i in face.vertices]
        low, high = (Vector(pick(c[i] for c in corners) for i in range(3)) for pick in (min, max))
        lengthwise = high.x - low.x >= high.y - low.y
        size = (LAMP_LENGTH, LAMP_WIDTH) if lengthwise else (LAMP_WIDTH, LAMP_LENGTH)
        for x in _spread(low.x, high.x):
            for y in _spread(low.y, high.y):
                place = Vector((x, y, low.z - BELOW_CEILING))
                if _has_room(building, place, size):
                    lamp = kit.place(data, "Ceiling lamp", place, 0.0 if lengthwise else math.pi / 2)
                    lamp.visible_camera = True


def _spread(low, high):
    count = math.ceil((high - low) / LAMP_SPACING)
    return [low + (high - low) * (i + 0.5) / count for i in range(count)]


def _has_room(building, place, size):
    down = Vector((0.0, 0.0, -1.0))
    hit, _, normal, _ = building.ray_cast(place, down)
    if not hit or normal.z < 0.99:
        return False
    for sx in (-0.5, 0.5):
        for sy in (-0.5, 0.5):
            corner = place + Vector((sx * size[0], sy * size[1], 0.0))
            along = corner - place
            if building.ray_cast(place, along.normalized(), distance=along.length)[0]:
                return False
            if not building.ray_cast(corner, -down, distance=2.0 * BELOW_CEILING)[0]:
                return False
    return True


def _cameras(building):
    """One at the end of a hallway; one far above, whose near plane cuts the ceilings off."""
    corners = [building.matrix_world @ Vector(c) for c in building.bound_box]
    low, high = (Vector(pick(c[i] for c in corners) for i in range(3)) for pick in (min, max))
    floor = low.z
    above = 60.0
    middle = (low + high) / 2.0
    overview = kit.add_camera(
        (middle.x, middle.y, floor + above), (middle.x, middle.y + 1e-3, floor), lens=40.0
    )
    overview.name = "Overview"
    overview.data.clip_start = above - CUT
    kit.add_camera((21.4, 29.1, floor + EYE), (45.0, 29.3, floor + EYE - 0.6), lens=20.0)
