# SPDX-License-Identifier: GPL-3.0-or-later
"""An office for four: desks face to face, shelves of books, windows on an overcast sky."""

import math
import random

from . import architecture, furniture, kit
from .materials import Palette

LOW, HIGH = (0.0, 0.0, 0.0), (6.8, 5.4, 2.8)
OUTER_WALL = 0.3
WINDOWS = [
    architecture.Opening(1, HIGH[1], HIGH[1] + OUTER_WALL, u0, u0 + 2.1, 0.88, 2.4)
    for u0 in (0.75, 3.75)
]
DOOR = architecture.Opening(0, -0.15, 0.0, 0.75, 1.7, 0.0, 2.08)
SHELVES_Y = (2.9, 3.82)  # middles of the two bookshelves along the west wall
SHELF_DEPTH, SHELF_WIDTH = 0.3, 0.9
LIGHTS = [((x - 0.62, y - 0.17), (x + 0.62, y + 0.17)) for x in (2.1, 4.6) for y in (1.6, 3.7)]

# Where the four sit: (x, y, turn about Z) of each desk; pairs stand back to back along y = 2.9.
DESKS = ((2.35, 2.48, 0.0), (4.0, 2.48, 0.0), (2.35, 3.32, math.pi), (4.0, 3.32, math.pi))


def build():
    kit.new_scene(400, 300)
    palette = Palette()
    rng = random.Random(11)
    _shell(palette)
    _sky()
    _workplaces(palette, rng)
    _along_the_walls(palette, rng)
    kit.add_camera((6.35, 0.35, 1.72), (2.35, 3.6, 0.98), lens=21.0)


def _shell(palette):
    white = palette["White paint"]
    shelves = [
        ((0.0, y - SHELF_WIDTH / 2), (SHELF_DEPTH, y + SHELF_WIDTH / 2)) for y in SHELVES_Y
    ]
    architecture.room(
        "Office", LOW, HIGH, palette["Carpet blue"], palette["Warm wall"], palette["Ceiling white"],
        holes={
            "north": [w.hole() for w in WINDOWS],
            "west": [DOOR.framed_hole()],
            "floor": shelves,
            "ceiling": LIGHTS,
        },
        wall_materials={"west": palette["Sage wall"]},
    )  # fmt: skip
    for i, opening in enumerate(WINDOWS):
        architecture.window(f"Window {i + 1}", opening, palette["Lacquer white"], white, (2, 1))
        sill = kit.Shape().box(
            (opening.u0 - 0.06, HIGH[1] - 0.16, opening.z0 - 0.03),
            (opening.u1 + 0.06, HIGH[1], opening.z0),
            white,
            skip=["north"],
        )
        sill.object(f"Window sill {i + 1}")
        radiator = furniture.radiator(palette, 1.6)
        kit.place(radiator, f"Radiator {i + 1}", ((opening.u0 + opening.u1) / 2, HIGH[1], 0.0))
    architecture.door_frame("Door frame", DOOR, palette["Walnut"], palette["Carpet blue"])
    leaf = architecture.door_leaf(0.94, 2.06, palette["Oak"], palette["Steel"])
    kit.place(leaf, "Door", (-0.055, DOOR.u0 + 0.003, 0.0), math.radians(90.0))
    glow = kit.emissive("Fluorescent light", (1.0, 0.93, 0.82), 11.0)
    for i, (low, high) in enumerate(LIGHTS):
        architecture.ceiling_light(
            f"Ceiling light {i + 1}", low, high, HIGH[2], glow, palette["Lacquer white"]
        )


def _sky():
    """A card outside each window: what one sees through it and the daylight that comes in."""
    sky = kit.emissive("Overcast sky", (0.78, 0.9, 1.0), 2.6)
    y = HIGH[1] + OUTER_WALL + 0.1
    for i, w in enumerate(WINDOWS):
        low, high = (w.u0 - 0.15, w.z0 - 0.15), (w.u1 + 0.15, w.z1 + 0.15)
        kit.Shape().sheet(1, y, low, high, sky, -1).object(f"Sky {i + 1}")


def _workplaces(palette, rng):
    screen = kit.principled_emissive("Screen", (0.02, 0.02, 0.025), (0.5, 0.72, 1.0), 0.7)
    desk = furniture.desk(palette)
    drawers = furniture.pedestal(palette)
    monitor = furniture.monitor(palette, screen)
    keyboard = furniture.keyboard(palette)
    mouse = furniture.mouse(palette)
    chairs = [furniture.office_chair(palette, c) for c in ("Chair blue", "Chair red")]
    lamp = furniture.desk_lamp(palette, "Brick red")
    mugs = [furniture.mug(palette, c) for c in ("Mustard", "Porcelain")]
    top = furniture.DESK_HEIGHT

    for i, (x, y, turn) in enumerate(DESKS):
        name = f"Workplace {i + 1}"
        cos, sin = math.cos(turn), math.sin(turn)

        def put(mesh, what, dx, dy, z, angle=0.0):
            at = (x + cos * dx - sin * dy, y + sin * dx + cos * dy, z)
            kit.place(mesh, f"{name} {what}", at, turn + angle)

        put(desk, "desk", 0.0, 0.0, 0.0)
        if i != 2:
            put(drawers, "drawers", 0.42, -0.05, 0.0)
        put(monitor, "monitor", rng.uniform(-0.15, 0.05), 0.18, top, rng.uniform(-0.15, 0.15))
        put(keyboard, "keyboard", -0.05, -0.18, top, rng.uniform(-0.06, 0.06))
        put(mouse, "mouse", 0.3, -0.17, top, rng.uniform(-0.3, 0.3))
        if i < 2:
            put(mugs[i], "mug", rng.uniform(0.45, 0.6), -0.1, top, rng.uniform(0.0, 6.0))
        put(furniture.papers(palette, rng), "papers", -0.55, -0.12, top, rng.uniform(-0.4, 0.4))
        put(
            chairs[i % 2], "chair", rng.uniform(-0.2, 0.1), -0.72 - rng.uniform(0.0, 0.2), 0.0,
            rng.uniform(-0.7, 0.7),
        )  # fmt: skip
        if i == 1:
            put(lamp, "lamp", -0.6, 0.2, top, -0.5)
        if i == 3:
            put(furniture.binders(palette, rng, 3), "binders", 0.4, 0.2, top)

    screens = kit.Shape()
    screens.box((1.6, 2.89, 0.66), (4.75, 2.91, 1.16), palette["Screen fabric"])
    screens.object("Desk divider")


def _along_the_walls(palette, rng):
    for i, y in enumerate(SHELVES_Y):
        shelf = furniture.bookshelf(palette, rng, SHELF_WIDTH, 1.95, SHELF_DEPTH)
        kit.place(shelf, f"Bookshelf {i + 1}", (SHELF_DEPTH / 2, y, 0.0), math.radians(90.0))
    box = kit.Shape().box((-0.17, -0.13, 0.0), (0.17, 0.13, 0.22), palette["Cardboard"], ["bottom"])
    box.object("Cardboard box", (0.15, SHELVES_Y[0] - 0.1, 1.95), 1.5)
    kit.place(furniture.plant(palette, rng, 1.5), "Plant", (0.55, 5.0, 0.0))
    kit.place(furniture.wall_clock(palette), "Clock", (3.3, HIGH[1], 2.1))
    bands = (("Book blue", 1.5), ("Book cream", 0.5), ("Book ochre", 1.0), ("Brick red", 0.7))
    art = furniture.picture(palette, 0.6, 0.8, "Black plastic", bands)
    kit.place(art, "Poster", (3.3, HIGH[1], 1.4))
    kit.place(furniture.waste_bin(palette), "Bin by the window", (5.25, 3.7, 0.0))

    # A whiteboard with a tray on the east wall.
    board = kit.Shape()
    board.box((-0.9, -0.02, 0.0), (0.9, 0.0, 1.1), palette["Steel"], skip=["south", "north"])
    board.sheet(1, -0.02, (-0.9, 0.0), (0.9, 1.1), palette["Paper"], -1)
    board.box((-0.4, -0.1, -0.03), (0.4, 0.0, 0.0), palette["Steel"], skip=["north"])
    board.object("Whiteboard", (HIGH[0], 3.1, 0.95), math.radians(-90.0))
