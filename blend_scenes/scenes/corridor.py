# SPDX-License-Identifier: GPL-3.0-or-later
"""A corridor with ten rooms, five a side, their doors open; light in the corridor and six rooms."""

import math
import random

from . import architecture, furniture, kit
from .materials import Palette

ROOMS_A_SIDE = 5
PITCH = 3.4  # from one room to the next along the corridor (m)
WALL = 0.16  # thickness of all inner walls
HALF_WIDTH = 1.0  # of the corridor
HEIGHT = 2.6
ROOM_DEPTH = 3.6
LENGTH = ROOMS_A_SIDE * PITCH - WALL
DOOR_WIDTH, DOOR_HEIGHT = 0.95, 2.05

# One letter a room from the corridor's start: a lamp in it, or dark.
LIT = {"North": "L.LL.", "South": ".L..L"}
WALL_PAINTS = {
    "North": ("Warm wall", "Sage wall", "Cool wall", "Warm wall", "Cool wall"),
    "South": ("Cool wall", "Warm wall", "Warm wall", "Sage wall", "Warm wall"),
}
LAMP_COLOURS = ((1.0, 0.88, 0.72), (0.86, 0.93, 1.0), (1.0, 0.8, 0.58))


def build():
    kit.new_scene(400, 300)
    palette = Palette()
    rng = random.Random(5)
    doors = {side: [_door(side, i) for i in range(ROOMS_A_SIDE)] for side in LIT}
    _corridor(palette, doors)
    leaf = architecture.door_leaf(
        DOOR_WIDTH - 0.01, DOOR_HEIGHT - 0.01, palette["Oak"], palette["Steel"]
    )
    pieces = _pieces(palette, rng)
    for side in LIT:
        for i in range(ROOMS_A_SIDE):
            _room(side, i, doors[side][i], palette, leaf, pieces)
    kit.add_camera((0.35, -0.25, 1.6), (9.0, 0.12, 1.12), lens=20.0)


def _door(side, i):
    near, far = HALF_WIDTH, HALF_WIDTH + WALL
    p0, p1 = (near, far) if side == "North" else (-far, -near)
    # Shifted along the corridor from side to side, so that no two doors face each other.
    u0 = i * PITCH + (1.9 if side == "North" else 0.9)
    return architecture.Opening(1, p0, p1, u0, u0 + DOOR_WIDTH, 0.0, DOOR_HEIGHT)


def _corridor(palette, doors):
    glow = kit.emissive("Corridor light", (1.0, 0.94, 0.85), 16.0)
    lights = []
    for x in (2.0, 5.2, 8.4, 11.6, 14.8):
        lights.append(((x - 0.6, -0.15), (x + 0.6, 0.15)))
    architecture.room(
        "Corridor", (0.0, -HALF_WIDTH, 0.0), (LENGTH, HALF_WIDTH, HEIGHT),
        palette["Linoleum"], palette["White paint"], palette["Ceiling white"],
        holes={
            "north": [d.framed_hole() for d in doors["North"]],
            "south": [d.framed_hole() for d in doors["South"]],
            "ceiling": lights,
        },
        wall_materials={"east": palette["Brick red"]},
    )  # fmt: skip
    for i, (low, high) in enumerate(lights):
        architecture.ceiling_light(
            f"Corridor light {i + 1}", low, high, HEIGHT, glow, palette["Steel"]
        )
    bench = furniture.table(palette, 1.3, 0.34, 0.44, "Walnut")
    kit.place(bench, "Bench", (4.3, 0.78, 0.0))
    bands = (("Book teal", 2.0), ("Mustard", 1.0), ("Book cream", 1.4))
    art = furniture.picture(palette, 0.8, 0.6, "Walnut", bands)
    kit.place(art, "Picture 1", (4.3, HALF_WIDTH, 1.55))
    kit.place(art, "Picture 2", (LENGTH, 0.0, 1.6), math.radians(-90.0))
    extinguisher = kit.Shape()
    extinguisher.lathe(
        (0.0, 0.0), [(0.0, 0.0), (0.07, 0.0), (0.07, 0.4), (0.0, 0.5)], palette["Brick red"], 8
    )
    extinguisher.object("Fire extinguisher", (2.75, -0.9, 0.75))


def _pieces(palette, rng):
    """The meshes that the rooms share."""
    return {
        "desk": furniture.desk(palette),
        "chair": furniture.stacking_chair(palette, "Chair blue"),
        "shelf": furniture.bookshelf(palette, rng, boards=5),
        "table": furniture.table(palette, 1.4, 0.8, 0.74, "Oak"),
        "red chair": furniture.stacking_chair(palette, "Chair red"),
        "cupboard": furniture.cupboard(palette, 1.2, 0.8),
        "plant": furniture.plant(palette, rng),
    }


def _room(side, i, door, palette, leaf, pieces):
    name = f"{side} room {i + 1}"
    north = side == "North"
    y = (HALF_WIDTH + WALL, HALF_WIDTH + WALL + ROOM_DEPTH)
    y0, y1 = y if north else (-y[1], -y[0])
    x0, x1 = i * PITCH, i * PITCH + PITCH - WALL
    lit = LIT[side][i] == "L"
    centre = ((x0 + x1) / 2, (y0 + y1) / 2)
    footprints = []
    sign = 1.0 if north else -1.0
    far, turn = (y1, 0.0) if north else (y0, math.pi)

    def put(piece, x, from_far, angle=0.0):
        kit.place(
            pieces[piece], f"{name} {piece}", (x, far - sign * from_far, 0.0), turn + angle
        )

    def put_solid(piece, x, from_far, width, depth):
        ya, yb = sorted((far - sign * (from_far - depth / 2), far - sign * (from_far + depth / 2)))
        footprints.append(((x - width / 2, ya), (x + width / 2, yb)))
        put(piece, x, from_far)

    if i % 2 == 0:
        put("desk", centre[0] + 0.2, 1.1)
        put("chair", centre[0] + 0.2, 1.9, 0.3)
        if i == 0 and north:
            put_solid("shelf", x0 + 0.8, 0.15, 0.9, 0.3)
    else:
        put("table", centre[0], 1.5, 0.15)
        put("red chair", centre[0] + 0.2, 2.35, 0.1)
        put_solid("cupboard", x1 - 0.8, 0.21, 1.2, 0.42)
    if lit and i == 0:
        put("plant", x1 - 0.5, 0.5)

    architecture.room(
        name, (x0, y0, 0.0), (x1, y1, HEIGHT),
        palette["Carpet" if i % 2 == 0 else "Parquet"],
        palette[WALL_PAINTS[side][i]], palette["Ceiling white"],
        holes={"south" if north else "north": [door.framed_hole()], "floor": footprints},
    )  # fmt: skip
    architecture.door_frame(f"{name} door frame", door, palette["White paint"], palette["Oak"])
    # Hinged at the end of the opening that is nearer the camera, swung into the room.
    hinge_y = (door.p1 if north else door.p0) + sign * 0.025
    swing = math.radians(100.0 - 7.0 * i)
    kit.place(leaf, f"{name} door", (door.u0 + 0.025, hinge_y, 0.0), sign * swing)
    if lit:
        lamp = kit.add_lamp(
            f"{name} lamp", "AREA", (*centre, HEIGHT - 0.03), (*centre, 0.0),
            LAMP_COLOURS[i % len(LAMP_COLOURS)], 35.0,
        )  # fmt: skip
        lamp.shape = "RECTANGLE"
        lamp.size, lamp.size_y = 1.2, 0.3
