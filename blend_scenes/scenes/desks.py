# SPDX-License-Identifier: GPL-3.0-or-later
"""Three open-plan offices side by side with desks in them, without a roof and seen from above.

After the "desks" scene of Mueckl and Dachsbacher (their Fig. 8): most pairs of patches are in
different offices and hidden from each other by two walls.
"""

import math
import random

from . import architecture, furniture, kit
from .materials import Palette

OFFICES = 3
WIDTH, DEPTH, HEIGHT = 4.6, 5.6, 2.5  # of one office, inside
WALL = 0.16
PITCH = WIDTH + WALL
DOOR_U = (0.6, 1.55)  # where along the dividing walls the doorways are
PAINTS = ("Warm wall", "Sage wall", "Cool wall")
FABRICS = ("Chair blue", "Chair red", "Chair blue")
FLOORS = ("Carpet", "Parquet", "Carpet blue")


def build():
    kit.new_scene(400, 300)
    palette = Palette()
    rng = random.Random(8)
    _walls(palette)
    screen = kit.principled_emissive("Screen", (0.02, 0.02, 0.025), (0.55, 0.75, 1.0), 0.5)
    pieces = {
        "desk": furniture.desk(palette, 1.4, 0.75),
        "drawers": furniture.pedestal(palette),
        "monitor": furniture.monitor(palette, screen),
        "keyboard": furniture.keyboard(palette),
        "mouse": furniture.mouse(palette),
        "mug": furniture.mug(palette, "Mustard"),
        "bin": furniture.waste_bin(palette),
    }
    for office in range(OFFICES):
        _office(office, palette, pieces, rng)
    middle = (OFFICES * PITCH - WALL) / 2
    kit.add_camera((middle - 1.2, -7.4, 9.2), (middle, 2.25, 0.35), lens=34.0)


def _x(office):
    return office * PITCH


def _walls(palette):
    """Floors, and walls as solids with their tops showing; the south side is cut away."""
    plaster = palette["White paint"]
    end = _x(OFFICES - 1) + WIDTH
    outer = kit.Shape()
    north = (DEPTH, DEPTH + WALL)
    for i in range(OFFICES):
        outer.sheet(
            1, DEPTH, (_x(i), 0.0), (_x(i) + WIDTH, HEIGHT), palette[PAINTS[i]], -1
        )
    outer.sheet(0, 0.0, (0.0, 0.0), (DEPTH, HEIGHT), palette[PAINTS[0]], +1)
    outer.sheet(0, end, (0.0, 0.0), (DEPTH, HEIGHT), palette[PAINTS[-1]], -1)
    outer.sheet(0, -WALL, (0.0, 0.0), (north[1], HEIGHT), plaster, -1)
    outer.sheet(0, end + WALL, (0.0, 0.0), (north[1], HEIGHT), plaster, +1)
    outer.sheet(1, north[1], (-WALL, 0.0), (end + WALL, HEIGHT), plaster, +1)
    for x0, x1 in ((-WALL, 0.0), (end, end + WALL)):
        outer.sheet(1, 0.0, (x0, 0.0), (x1, HEIGHT), plaster, -1)
        outer.sheet(2, HEIGHT, (x0, 0.0), (x1, DEPTH), plaster, +1)
    outer.sheet(2, HEIGHT, (-WALL, north[0]), (end + WALL, north[1]), plaster, +1)
    outer.object("Outer walls")
    for i in range(OFFICES - 1):
        x0, x1 = _x(i) + WIDTH, _x(i + 1)
        door = architecture.Opening(0, x0, x1, *DOOR_U, 0.0, 2.05)
        wall = kit.Shape()
        hole = [door.framed_hole()]
        wall.sheet(0, x0, (0.0, 0.0), (DEPTH, HEIGHT), palette[PAINTS[i]], -1, hole)
        wall.sheet(0, x1, (0.0, 0.0), (DEPTH, HEIGHT), palette[PAINTS[i + 1]], +1, hole)
        wall.sheet(1, 0.0, (x0, 0.0), (x1, HEIGHT), plaster, -1)
        wall.sheet(2, HEIGHT, (x0, 0.0), (x1, DEPTH), plaster, +1)
        wall.object(f"Dividing wall {i + 1}")
        architecture.door_frame(f"Doorway {i + 1}", door, palette["Walnut"], palette["Oak"])


def _office(office, palette, pieces, rng):
    x = _x(office)
    name = f"Office {office + 1}"
    chair = furniture.office_chair(palette, FABRICS[office])
    shelf_x = (x + 0.75, x + 3.0)
    footprints = [((sx - 0.45, DEPTH - 0.3), (sx + 0.45, DEPTH)) for sx in shelf_x]
    kit.Shape().sheet(
        2, 0.0, (x, 0.0), (x + WIDTH, DEPTH), palette[FLOORS[office]], +1, footprints
    ).object(f"{name} floor")
    for sx in shelf_x:
        shelf = furniture.bookshelf(palette, rng, 0.9, 1.6, 0.3, boards=4)
        kit.place(shelf, f"{name} bookshelf", (sx, DEPTH - 0.15, 0.0))
    kit.place(furniture.plant(palette, rng, 1.2, 24), f"{name} plant", (x + 4.15, 5.1, 0.0))
    kit.place(pieces["bin"], f"{name} bin", (x + 1.9, 5.25, 0.0))

    # Two pairs of desks back to back, one beside the other.
    for row, y in enumerate((2.15, 2.92)):
        for column in range(2):
            place = (x + 1.45 + 1.75 * column, y, math.pi * row)
            _workplace(f"{name} workplace {2 * row + column + 1}", place, chair, palette, pieces, rng)
    for column in range(2):
        fabric = palette["Screen fabric"]
        at = x + 1.45 + 1.75 * column
        kit.Shape().box((at - 0.7, 2.525, 0.66), (at + 0.7, 2.545, 1.1), fabric).object(
            f"{name} divider {column + 1}"
        )
    for i, y in enumerate((1.5, 3.9)):
        lamp = kit.add_lamp(
            f"{name} lamp {i + 1}", "AREA", (x + WIDTH / 2, y, 2.45), (x + WIDTH / 2, y, 0.0),
            ((1.0, 0.93, 0.82), (1.0, 0.86, 0.68), (0.9, 0.95, 1.0))[office], 85.0,
        )  # fmt: skip
        lamp.shape = "RECTANGLE"
        lamp.size, lamp.size_y = 1.5, 0.5


def _workplace(name, place, chair, palette, pieces, rng):
    x, y, turn = place
    cos, sin = math.cos(turn), math.sin(turn)
    top = furniture.DESK_HEIGHT

    def put(mesh, what, dx, dy, z, angle=0.0):
        at = (x + cos * dx - sin * dy, y + sin * dx + cos * dy, z)
        kit.place(mesh, f"{name} {what}", at, turn + angle)

    put(pieces["desk"], "desk", 0.0, 0.0, 0.0)
    put(pieces["drawers"], "drawers", 0.38, -0.04, 0.0)
    put(pieces["monitor"], "monitor", rng.uniform(-0.1, 0.1), 0.16, top, rng.uniform(-0.2, 0.2))
    put(pieces["keyboard"], "keyboard", -0.05, -0.18, top, rng.uniform(-0.06, 0.06))
    put(pieces["mouse"], "mouse", 0.28, -0.17, top, rng.uniform(-0.3, 0.3))
    put(chair, "chair", rng.uniform(-0.15, 0.15), -0.75, 0.0, rng.uniform(-0.8, 0.8))
    if rng.random() < 0.6:
        put(pieces["mug"], "mug", rng.uniform(0.4, 0.55), 0.05, top, rng.uniform(0.0, 6.0))
    put(furniture.papers(palette, rng, 3), "papers", -0.48, -0.1, top, rng.uniform(-0.5, 0.5))
