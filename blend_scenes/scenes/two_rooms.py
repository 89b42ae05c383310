# SPDX-License-Identifier: GPL-3.0-or-later
"""Two rooms and a doorway: the lamp is in the far one, the camera in the near one."""

import math

from . import architecture, furniture, kit
from .materials import Palette

HEIGHT = 2.7
FAR = ((0.0, 0.0, 0.0), (4.0, 4.6, HEIGHT))
WALL = 0.2  # thickness of the wall between them
NEAR = ((4.0 + WALL, 0.0, 0.0), (8.2, 4.6, HEIGHT))
DOOR = architecture.Opening(axis=0, p0=4.0, p1=4.0 + WALL, u0=1.7, u1=2.7, z0=0.0, z1=2.1)
LIGHT = ((1.3, 1.6), (2.7, 2.8))  # its hole in the far room's ceiling
CUPBOARD = (4.42, 3.75)  # centre of its footprint, against the wall between the rooms


def build():
    kit.new_scene(400, 300)
    palette = Palette()
    glow = kit.emissive("Ceiling light", (1.0, 0.9, 0.76), 22.0)
    parquet, white, warm = palette["Parquet"], palette["Ceiling white"], palette["Warm wall"]
    brick, sage = palette["Brick red"], palette["Sage wall"]

    door_hole = DOOR.framed_hole()
    footprint = ((CUPBOARD[0] - 0.22, CUPBOARD[1] - 0.45), (CUPBOARD[0] + 0.22, CUPBOARD[1] + 0.45))
    architecture.room(
        "Far room", *FAR, parquet, warm, white,
        holes={"east": [door_hole], "ceiling": [LIGHT]}, wall_materials={"west": brick},
    )  # fmt: skip
    architecture.room(
        "Near room", *NEAR, palette["Linoleum"], palette["Cool wall"], white,
        holes={"west": [door_hole], "floor": [footprint]}, wall_materials={"north": sage},
    )  # fmt: skip
    architecture.door_frame("Door frame", DOOR, palette["White paint"], parquet)
    leaf = architecture.door_leaf(0.99, 2.09, palette["White paint"], palette["Steel"])
    kit.place(leaf, "Door", (4.0 + WALL + 0.03, 1.71, 0.0), math.radians(-12.0))
    architecture.ceiling_light("Ceiling light", *LIGHT, HEIGHT, glow, palette["Steel"])

    kit.place(furniture.table(palette, 1.3, 0.8, 0.74, "Oak"), "Table", (2.0, 2.3, 0.0), 0.1)
    chair = furniture.wooden_chair(palette, "Walnut")
    kit.place(chair, "Chair 1", (2.75, 1.75, 0.0), math.radians(150.0))
    kit.place(chair, "Chair 2", (1.3, 2.9, 0.0), math.radians(-20.0))
    kit.place(furniture.mug(palette, "Mustard"), "Mug", (2.25, 2.35, 0.74))
    cupboard = furniture.cupboard(palette, 0.9, 0.85, 0.44, "White paint", "Beech")
    kit.place(cupboard, "Cupboard", (*CUPBOARD, 0.0), math.radians(90.0))
    kit.place(chair, "Chair 3", (6.6, 3.3, 0.0), math.radians(35.0))
    kit.place(furniture.waste_bin(palette), "Bin", (5.2, 4.25, 0.0))
    kit.add_camera((7.95, 1.15, 1.55), (4.0, 2.75, 1.05), lens=22.0)
