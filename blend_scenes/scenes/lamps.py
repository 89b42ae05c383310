# SPDX-License-Identifier: GPL-3.0-or-later
"""One scene for each type of Blender lamp, over a floor and a wall with a block on the floor.

They exist to compare units: power to radiance, soft sizes, the spot's falloff, the sun's angle.
The view holds nothing but lit surfaces, so that the mean of the picture is a fair measure.
"""

import math

from . import kit

BLOCK = ((-1.1, -0.2), (-0.5, 0.4))  # its footprint (m)
BLOCK_HEIGHT = 0.8
WARM = (1.0, 0.85, 0.7)  # no two channels alike: a swapped or lost channel shows


def _stage():
    kit.new_scene(400, 300)
    grey = kit.diffuse("Grey floor", (0.5, 0.5, 0.5))
    wall = kit.principled("Plaster", (0.6, 0.58, 0.55))
    red = kit.diffuse("Red block", (0.55, 0.12, 0.08))
    kit.Shape().sheet(2, 0.0, (-4.0, -4.0), (4.0, 1.5), grey, +1, holes=[BLOCK]).object("Floor")
    kit.Shape().sheet(1, 1.5, (-4.0, 0.0), (4.0, 4.0), wall, -1).object("Wall")
    (x0, y0), (x1, y1) = BLOCK
    block = kit.Shape().box((x0, y0, 0.0), (x1, y1, BLOCK_HEIGHT), red, skip=["bottom"])
    block.object("Block")
    kit.add_camera((0.0, -3.6, 1.5), (0.0, 1.5, 1.0), lens=32.0)


def build_point():
    _stage()
    lamp = kit.add_lamp("Point", "POINT", (0.6, -0.3, 1.6), (0.6, -0.3, 0.0), WARM, 150.0)
    lamp.shadow_soft_size = 0.15


def build_spot():
    _stage()
    lamp = kit.add_lamp("Spot", "SPOT", (1.2, -1.8, 2.6), (-0.2, 0.9, 0.3), WARM, 900.0)
    lamp.shadow_soft_size = 0.1
    lamp.spot_size = math.radians(62.0)
    lamp.spot_blend = 0.4


def build_sun():
    _stage()
    lamp = kit.add_lamp("Sun", "SUN", (2.6, -1.4, 2.6), (0.0, 0.0, 0.0), WARM, 4.0)
    lamp.angle = math.radians(4.0)


# Shape, sizes (m) and power (W) of the four lamps of lamp_area, from left to right.
AREA_SHAPES = (
    ("SQUARE", 0.5, 0.5),
    ("RECTANGLE", 0.7, 0.25),
    ("DISK", 0.55, 0.55),
    ("ELLIPSE", 0.7, 0.35),
)
BAY_WIDTH = 1.3
BAY_DEPTH = 1.2
BAY_HEIGHT = 4.2
PARTITION = 0.06  # thickness (m)


def build_area():
    """Four bays, each lit by one shape; each fills a quarter of the picture's width."""
    kit.new_scene(400, 300)
    grey = kit.diffuse("Grey floor", (0.5, 0.5, 0.5))
    wall = kit.principled("Plaster", (0.6, 0.58, 0.55))
    left = -2.0 * BAY_WIDTH
    footprints = []
    for i in range(5):
        x = left + i * BAY_WIDTH
        footprints.append(((x - PARTITION / 2, -BAY_DEPTH), (x + PARTITION / 2, 0.0)))
    kit.Shape().sheet(
        2, 0.0, (left - 0.5, -4.0), (-left + 0.5, 0.0), grey, +1, holes=footprints
    ).object("Floor")
    for i, ((x0, y0), (x1, y1)) in enumerate(footprints):
        partition = kit.Shape().box(
            (x0, y0, 0.0), (x1, y1, BAY_HEIGHT), wall, skip=["bottom", "north"]
        )
        partition.object(f"Partition {i + 1}")
    for i, (shape, size_x, size_y) in enumerate(AREA_SHAPES):
        x0, x1 = footprints[i][1][0], footprints[i + 1][0][0]
        kit.Shape().sheet(1, 0.0, (x0, 0.0), (x1, BAY_HEIGHT), wall, -1).object(f"Wall {i + 1}")
        centre = (x0 + x1) / 2.0
        lamp = kit.add_lamp(
            f"Area {shape.lower()}", "AREA", (centre, -0.75, 2.6), (centre, -0.45, 0.0), WARM, 40.0
        )
        lamp.shape = shape
        lamp.size = size_x
        lamp.size_y = size_y
    # The partitions' front edges divide the picture into quarters: 4 bays fill the 36 mm.
    distance = 5.4
    lens = 36.0 * distance / (4.0 * BAY_WIDTH)
    eye = (0.0, -BAY_DEPTH - distance, 1.35)
    kit.add_camera(eye, (0.0, 0.0, 1.35), lens=lens)
