# SPDX-License-Identifier: GPL-3.0-or-later
"""Every way of Blender to make geometry that the renderer has to follow, in one lit scene.

Instances of a collection and on vertices, negative scale, array, subdivision and mirror modifiers,
n-gons convex and concave, text, a bevelled curve, several material slots, no material at all; and
things that must not be seen: hidden objects, a hidden collection, a hidden lamp.
"""

import math

import bmesh
import bpy

from . import kit

FLOOR_LOW, FLOOR_HIGH = (-3.0, -3.5), (4.2, 2.0)
WALL_HEIGHT = 3.6


def build():
    kit.new_scene(400, 300)
    _stage()
    _collection_instances()
    _vertex_instances()
    _negative_scale()
    _modifiers()
    _ngons()
    _text_and_curve()
    _slots()
    _hidden()
    lamp = kit.add_lamp("Key", "AREA", (-1.8, -2.2, 3.0), (0.0, 0.4, 0.5), (1.0, 0.95, 0.88), 130.0)
    lamp.shape = "RECTANGLE"
    lamp.size, lamp.size_y = 1.2, 0.8
    kit.add_camera((0.25, -4.3, 1.9), (0.05, 0.6, 0.85), lens=31.0)


def _stage():
    floor = kit.diffuse("Floor", (0.5, 0.48, 0.45))
    wall = kit.principled("Wall", (0.7, 0.7, 0.68))
    side = kit.diffuse("Side wall", (0.2, 0.32, 0.5))
    glow = kit.emissive("Glow", (1.0, 0.72, 0.4), 6.0)
    kit.Shape().sheet(2, 0.0, FLOOR_LOW, FLOOR_HIGH, floor, +1).object("Floor")
    panel = ((1.2, 2.2), (2.6, 2.6))
    kit.Shape().sheet(
        1, FLOOR_HIGH[1], (FLOOR_LOW[0], 0.0), (FLOOR_HIGH[0], WALL_HEIGHT), wall, -1, holes=[panel]
    ).object("Back wall")
    kit.Shape().sheet(1, FLOOR_HIGH[1], *panel, glow, -1).object("Glowing panel")
    kit.Shape().sheet(
        0, FLOOR_LOW[0], (FLOOR_LOW[1], 0.0), (FLOOR_HIGH[1], WALL_HEIGHT), side, +1
    ).object("Left wall")


def _collection_instances():
    """A stool, in a collection that is itself not in the scene, shown by three empties."""
    seat = kit.diffuse("Stool seat", (0.6, 0.25, 0.06))
    leg = kit.principled("Stool leg", (0.15, 0.09, 0.05))
    parts = kit.Shape().cylinder((0.0, 0.0), 0.22, 0.45, 0.5, seat, segments=12)
    for x in (-0.12, 0.12):
        for y in (-0.12, 0.12):
            parts.box((x - 0.02, y - 0.02, 0.0), (x + 0.02, y + 0.02, 0.45), leg, skip=["top"])
    stool = bpy.data.collections.new("Stool")
    stool.objects.link(bpy.data.objects.new("Stool", parts.mesh("Stool")))
    places = (
        ((-2.3, 0.9, 0.0), 0.3, (1.0, 1.0, 1.0)),
        ((-2.45, 0.1, 0.0), 0.9, (1.0, 1.0, 0.7)),
        ((-1.75, 0.35, 0.0), 0.0, (0.7, 0.7, 1.2)),
    )
    for i, (location, turn, scale) in enumerate(places):
        empty = bpy.data.objects.new(f"Stool instance {i + 1}", None)
        empty.instance_type = "COLLECTION"
        empty.instance_collection = stool
        empty.location = location
        empty.rotation_euler = (0.0, 0.0, turn)
        empty.scale = scale
        bpy.context.scene.collection.objects.link(empty)


def _vertex_instances():
    """A cone on each vertex of a 4 x 3 grid, which is itself not rendered."""
    paint = kit.diffuse("Cone paint", (0.75, 0.6, 0.1))
    cone = kit.Shape().lathe((0.0, 0.0), [(0.07, 0.0), (0.0, 0.28)], paint, segments=8)
    child = cone.object("Cone on vertices")
    edit = bmesh.new()
    bmesh.ops.create_grid(edit, x_segments=3, y_segments=2, size=0.5)
    mesh = bpy.data.meshes.new("Cone grid")
    edit.to_mesh(mesh)
    edit.free()
    parent = kit.place(mesh, "Cone grid", (-1.2, -0.55, 0.0))
    parent.instance_type = "VERTS"
    parent.show_instancer_for_render = False
    child.parent = parent


def _negative_scale():
    """A bracket that is not its own mirror image, and its mirrored twins."""
    paint = kit.principled("Bracket paint", (0.1, 0.35, 0.15))
    bracket = kit.Shape()
    outline = [(0.0, 0.0), (0.45, 0.0), (0.45, 0.12), (0.12, 0.12), (0.12, 0.3), (0.0, 0.3)]
    bracket.prism(outline, 0.0, 0.35, paint)
    mesh = bracket.mesh("Bracket")
    kit.place(mesh, "Bracket", (-0.55, -1.35, 0.0))
    mirrored = kit.place(mesh, "Bracket mirrored in X", (0.65, -1.35, 0.0))
    mirrored.scale = (-1.0, 1.0, 1.0)
    upside_down = kit.place(mesh, "Bracket mirrored in all", (1.5, -1.05, 0.35))
    upside_down.scale = (-1.0, -1.0, -1.0)


def _modifiers():
    stone = kit.diffuse("Step stone", (0.55, 0.5, 0.42))
    step = kit.Shape().box((0.0, 0.0, 0.0), (0.6, 0.22, 0.14), stone).object(
        "Steps (array)", (1.95, 0.35, 0.0)
    )
    array = step.modifiers.new("Array", "ARRAY")
    array.count = 5
    array.use_relative_offset = True
    array.relative_offset_displace = (0.0, 1.0, 1.0)

    rubber = kit.principled("Rubber", (0.5, 0.08, 0.1))
    ball = kit.Shape().box((-0.3, -0.3, -0.3), (0.3, 0.3, 0.3), rubber).object(
        "Ball (subdivision)", (-0.55, 0.55, 0.24)
    )
    for polygon in ball.data.polygons:
        polygon.use_smooth = True
    subdivision = ball.modifiers.new("Subdivision", "SUBSURF")
    subdivision.levels = 1  # the viewport's; the render must use the other
    subdivision.render_levels = 2

    paint = kit.diffuse("Arch paint", (0.35, 0.2, 0.45))
    half = kit.Shape()
    half.box((0.35, 0.0, 0.0), (0.55, 0.2, 0.8), paint, skip=["top"])
    half.polygon([(0.35, 0.0, 0.8), (0.55, 0.0, 0.8), (0.0, 0.0, 1.3), (0.0, 0.0, 1.1)], paint)
    half.polygon([(0.55, 0.2, 0.8), (0.35, 0.2, 0.8), (0.0, 0.2, 1.1), (0.0, 0.2, 1.3)], paint)
    half.polygon([(0.55, 0.0, 0.8), (0.55, 0.2, 0.8), (0.0, 0.2, 1.3), (0.0, 0.0, 1.3)], paint)
    half.polygon([(0.35, 0.2, 0.8), (0.35, 0.0, 0.8), (0.0, 0.0, 1.1), (0.0, 0.2, 1.1)], paint)
    arch = half.object("Arch (mirror)", (0.85, 1.1, 0.0))
    arch.modifiers.new("Mirror", "MIRROR").use_axis = (True, False, False)


def _ngons():
    """A star (concave caps of ten corners) and a hexagonal post (convex ones)."""
    yellow = kit.diffuse("Star paint", (0.8, 0.7, 0.2))
    star = []
    for i in range(10):
        radius = 0.38 if i % 2 == 0 else 0.16
        angle = math.pi * i / 5.0 + math.pi / 2.0
        star.append((radius * math.cos(angle), radius * math.sin(angle)))
    thing = kit.Shape().prism(star, -0.06, 0.06, yellow).object("Star", (-1.2, 1.75, 1.9))
    thing.rotation_euler = (math.radians(90.0), 0.0, math.radians(8.0))

    grey = kit.principled("Post paint", (0.4, 0.42, 0.45))
    kit.Shape().cylinder((0.0, 0.0), 0.15, 0.0, 1.3, grey, segments=6, bottom=False).object(
        "Hexagonal post", (-1.15, 1.3, 0.0)
    )


def _text_and_curve():
    letters = bpy.data.curves.new("Text", "FONT")
    letters.body = "light"
    letters.size = 0.55
    letters.extrude = 0.06
    letters.align_x = "CENTER"
    letters.resolution_u = 3
    letters.materials.append(kit.principled("Letter paint", (0.12, 0.2, 0.55)))
    text = bpy.data.objects.new("Text", letters)
    text.location = (0.35, 1.85, 1.75)
    text.rotation_euler = (math.radians(90.0), 0.0, 0.0)
    bpy.context.scene.collection.objects.link(text)

    spiral = bpy.data.curves.new("Spring", "CURVE")
    spiral.dimensions = "3D"
    spiral.bevel_depth = 0.035
    spiral.bevel_resolution = 1
    spiral.use_fill_caps = True
    spline = spiral.splines.new("POLY")
    steps = 48
    spline.points.add(steps)
    for i, point in enumerate(spline.points):
        angle = 2.0 * math.pi * 3.0 * i / steps
        point.co = (0.22 * math.cos(angle), 0.22 * math.sin(angle), 0.04 + 0.7 * i / steps, 1.0)
    spiral.materials.append(kit.diffuse("Spring steel", (0.6, 0.6, 0.62)))
    curve = bpy.data.objects.new("Spring", spiral)
    curve.location = (0.55, 0.15, 0.0)
    bpy.context.scene.collection.objects.link(curve)


def _slots():
    """One mesh of three materials, and one of none (Blender shows that as .8 grey)."""
    colours = ((0.7, 0.15, 0.1), (0.15, 0.5, 0.2), (0.1, 0.2, 0.6))
    tower = kit.Shape()
    for i, colour in enumerate(colours):
        tower.box(
            (-0.15, -0.15, 0.3 * i),
            (0.15, 0.15, 0.3 * (i + 1)),
            kit.diffuse(f"Tower {i + 1}", colour),
            skip=["bottom"] + (["top"] if i < len(colours) - 1 else []),
        )
    tower.object("Tower of three slots", (1.35, -0.1, 0.0), 0.5)

    mesh = bpy.data.meshes.new("No material")
    edit = bmesh.new()
    bmesh.ops.create_icosphere(edit, subdivisions=2, radius=0.22)
    edit.to_mesh(mesh)
    edit.free()
    kit.place(mesh, "Ball without material", (0.05, -0.55, 0.22))


def _hidden():
    """Would stand in front of everything, or flood it with green, if it were rendered."""
    green = kit.emissive("Must not be seen", (0.0, 1.0, 0.0), 20.0)
    box = kit.Shape().box((-1.5, -2.6, 0.0), (1.5, -2.4, 2.4), green).object("Hidden screen")
    box.hide_render = True

    inside = kit.Shape().box((-0.4, -0.4, 0.0), (0.4, 0.4, 1.6), green)
    hidden = bpy.data.collections.new("Hidden collection")
    hidden.hide_render = True
    bpy.context.scene.collection.children.link(hidden)
    thing = bpy.data.objects.new("In a hidden collection", inside.mesh("Hidden box"))
    thing.location = (0.0, -1.9, 0.0)
    hidden.objects.link(thing)

    kit.add_lamp("Hidden lamp", "POINT", (0.0, -2.0, 2.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), 500.0)
    bpy.data.objects["Hidden lamp"].hide_render = True

    white = kit.diffuse("Shown in renders", (0.75, 0.75, 0.75))
    cube = kit.Shape().box((-0.14, -0.14, 0.0), (0.14, 0.14, 0.28), white, skip=["bottom"])
    thing = cube.object("Hidden in the viewport only", (2.15, -0.7, 0.0), 0.35)
    thing.hide_viewport = True
