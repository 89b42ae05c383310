# SPDX-License-Identifier: GPL-3.0-or-later
"""Two rooms and a doorway: the only lamp is in the room with the camera, the other lies beyond."""

import math

from . import architecture, furniture, kit
from .materials import Palette

HEIGHT = 2.7
LIT = ((0.0, 0.0, 0.0), (4.0, 4.6, HEIGHT))
WALL = 0.2  # thickness of the wall between them
DARK = ((4.0 + WALL, 0.0, 0.0), (8.2, 4.6, HEIGHT))
DOOR = architecture.Opening(axis=0, p0=4.0, p1=4.0 + WALL, u0=1.5, u1=3.1, z0=0.0, z1=2.15)
LIGHT = ((1.3, 1.6), (2.7, 2.8))  # its hole in the lit room's ceiling
CUPBOARD = (7.98, 3.2)  # centre of its footprint, against the dark room's far wall


def build():
    kit.new_scene(400, 300)
    palette = Palette()
    glow = kit.emissive("Ceiling light", (1.0, 0.9, 0.76), 16.0)
    parquet, white, warm = palette["Parquet"], palette["Ceiling white"], palette["Warm wall"]

    door_hole = DOOR.framed_hole()
    footprint = ((CUPBOARD[0] - 0.22, CUPBOARD[1] - 0.45), (CUPBOARD[0] + 0.22, CUPBOARD[1] + 0.45))
    architecture.room(
        "Lit room", *LIT, parquet, warm, white,
        holes={"east": [door_hole], "ceiling": [LIGHT]},
        wall_materials={"north": palette["Brick red"]},
    )  # fmt: skip
    architecture.room(
        "Dark room", *DARK, palette["Linoleum"], palette["Cool wall"], white,
        holes={"west": [door_hole], "floor": [footprint]},
        wall_materials={"north": palette["Sage wall"]},
    )  # fmt: skip
    architecture.door_frame("Door frame", DOOR, palette["White paint"], parquet)
    leaf = architecture.door_leaf(0.79, 2.14, palette["White paint"], palette["Steel"])
    for name, y, turn in (("Door 1", DOOR.u0 + 0.005, -14.0), ("Door 2", DOOR.u1 - 0.005, 20.0)):
        kit.place(leaf, name, (4.0 + WALL + 0.04, y, 0.0), math.radians(turn))
    architecture.ceiling_light("Ceiling light", *LIGHT, HEIGHT, glow, palette["Steel"])

    kit.place(furniture.table(palette, 1.3, 0.8, 0.74, "Oak"), "Table", (2.3, 3.2, 0.0), 0.1)
    chair = furniture.wooden_chair(palette, "Walnut")
    kit.place(chair, "Chair 1", (2.2, 2.45, 0.0), math.radians(-15.0))
    kit.place(chair, "Chair 2", (2.5, 3.95, 0.0), math.radians(170.0))
    kit.place(furniture.mug(palette, "Mustard"), "Mug", (2.1, 3.05, 0.74))
    bands = (("Book teal", 2.0), ("Mustard", 1.0), ("Book cream", 1.4))
    art = furniture.picture(palette, 0.6, 0.8, "Walnut", bands)
    kit.place(art, "Picture", (LIT[1][0], 0.75, 1.55), math.radians(-90.0))
    cupboard = furniture.cupboard(palette, 0.9, 0.85, 0.44, "White paint", "Beech")
    kit.place(cupboard, "Cupboard", (*CUPBOARD, 0.0), math.radians(-90.0))
    kit.place(chair, "Chair 3", (6.4, 2.0, 0.0), math.radians(60.0))
    kit.place(furniture.waste_bin(palette), "Bin", (3.7, 4.2, 0.0))
    kit.add_camera((1.55, 1.05, 1.55), (4.1, 2.35, 1.17), lens=21.0)
