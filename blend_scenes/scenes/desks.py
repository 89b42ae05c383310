# SPDX-License-Identifier: GPL-3.0-or-later
"""An open-plan hall with three groups of four desks; two walls part the groups.

After the "desks" scene of Mueckl and Dachsbacher (their Fig. 8): most pairs of patches belong to
different groups and are hidden from each other by the two walls, where two blocking planes can
stand.
"""

import math
import random

from . import architecture, furniture, kit
from .materials import Palette

GROUPS = 3
BAY, WALL = 3.6, 0.16  # width of one group's bay, and thickness of the walls between (m)
PITCH = BAY + WALL
LENGTH = GROUPS * PITCH - WALL
DEPTH, HEIGHT = 6.4, 2.9
PASSAGE = 2.3  # what the walls leave free along the south side (m)
FABRICS = ("Chair blue", "Chair red", "Screen fabric")
PAINTS = ("Book ochre", "Sage wall", "Book blue")  # of the north wall, bay by bay
LAMP_COLOURS = ((1.0, 0.86, 0.68), (1.0, 0.95, 0.88), (0.86, 0.93, 1.0))
SHELF = (0.9, 1.25, 0.3)  # width, height, depth


def build():
    kit.new_scene(400, 300)
    palette = Palette()
    rng = random.Random(8)
    _hall(palette)
    screen = kit.principled_emissive("Screen", (0.02, 0.02, 0.025), (0.55, 0.75, 1.0), 0.5)
    pieces = {
        "desk": furniture.desk(palette, 1.4, 0.7),
        "monitor": furniture.monitor(palette, screen),
        "keyboard": furniture.keyboard(palette),
        "mouse": furniture.mouse(palette),
        "papers": furniture.papers(palette, rng),
        "shelf": furniture.bookshelf(palette, rng, *SHELF, boards=4),
    }
    for group in range(GROUPS):
        _group(group, palette, pieces, rng)
    kit.add_camera((LENGTH / 2 - 1.1, 0.12, 2.45), (LENGTH / 2 + 0.15, 3.6, 0.95), lens=16.0)


def _bay(group):
    """Where the group's bay starts and ends along X."""
    return group * PITCH, group * PITCH + BAY


def _shelf(group):
    """The footprint of the group's bookshelf at the north wall."""
    x = _bay(group)[0] + 0.75
    return ((x - SHELF[0] / 2, DEPTH - SHELF[2]), (x + SHELF[0] / 2, DEPTH))


def _hall(palette):
    """A shell around all, and the parting walls as solids that end at floor, ceiling and wall."""
    white = palette["White paint"]
    parting = [(_bay(i)[1], _bay(i + 1)[0]) for i in range(GROUPS - 1)]
    feet = [((a, PASSAGE), (b, DEPTH)) for a, b in parting]
    architecture.room(
        "Hall", (0.0, 0.0, 0.0), (LENGTH, DEPTH, HEIGHT),
        palette["Carpet"], white, palette["Ceiling white"],
        holes={
            "floor": feet + [_shelf(i) for i in range(GROUPS)],
            "ceiling": feet,
            "north": [((0.0, 0.0), (LENGTH, HEIGHT))],
        },
    )  # fmt: skip
    walls = kit.Shape()
    for i in range(GROUPS):
        a, b = _bay(i)
        walls.sheet(1, DEPTH, (a, 0.0), (b, HEIGHT), palette[PAINTS[i]], -1)
    walls.object("North wall")
    for i, (a, b) in enumerate(parting):
        wall = kit.Shape().box(
            (a, PASSAGE, 0.0), (b, DEPTH, HEIGHT), palette["Warm wall"],
            skip=["north", "bottom", "top"],
        )  # fmt: skip
        wall.object(f"Parting wall {i + 1}")


def _group(group, palette, pieces, rng):
    name = f"Group {group + 1}"
    x0, x1 = _bay(group)
    middle = (x0 + x1) / 2
    chair = furniture.stacking_chair(palette, FABRICS[group])
    low, high = _shelf(group)
    kit.place(
        pieces["shelf"], f"{name} bookshelf", ((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, 0.0)
    )
    if group == 1:
        kit.place(furniture.plant(palette, rng, 1.3), f"{name} plant", (x1 - 0.6, DEPTH - 0.6, 0.0))
    else:
        kit.place(furniture.waste_bin(palette), f"{name} bin", (x1 - 0.5, DEPTH - 0.4, 0.0))

    # Two pairs of desks back to back, the pairs side by side along X.
    for row, y in enumerate((3.25, 3.99)):
        for column in range(2):
            place = (middle - 0.72 + 1.44 * column, y, math.pi * row)
            _workplace(f"{name} workplace {2 * row + column + 1}", place, chair, pieces, rng)
    divider = kit.Shape()
    divider.box((x0 + 0.4, 3.61, 0.66), (x1 - 0.4, 3.63, 1.08), palette["Screen fabric"])
    divider.object(f"{name} divider")
    for i, y in enumerate((1.2, 3.62)):
        lamp = kit.add_lamp(
            f"{name} lamp {i + 1}", "AREA", (middle, y, HEIGHT - 0.02), (middle, y, 0.0),
            LAMP_COLOURS[group], (45.0, 80.0)[i],
        )  # fmt: skip
        lamp.shape = "RECTANGLE"
        lamp.size, lamp.size_y = 1.5, 0.4


def _workplace(name, place, chair, pieces, rng):
    x, y, turn = place
    cos, sin = math.cos(turn), math.sin(turn)
    top = furniture.DESK_HEIGHT

    def put(mesh, what, dx, dy, z, angle=0.0):
        at = (x + cos * dx - sin * dy, y + sin * dx + cos * dy, z)
        kit.place(mesh, f"{name} {what}", at, turn + angle)

    put(pieces["desk"], "desk", 0.0, 0.0, 0.0)
    put(pieces["monitor"], "monitor", rng.uniform(-0.1, 0.1), 0.14, top, rng.uniform(-0.15, 0.15))
    put(pieces["keyboard"], "keyboard", -0.05, -0.18, top, rng.uniform(-0.06, 0.06))
    put(pieces["mouse"], "mouse", 0.28, -0.17, top, rng.uniform(-0.3, 0.3))
    put(chair, "chair", rng.uniform(-0.12, 0.12), -0.72, 0.0, rng.uniform(-0.4, 0.4))
    if rng.random() < 0.6:
        put(pieces["papers"], "papers", -0.45, -0.1, top, rng.uniform(-0.2, 0.2))
