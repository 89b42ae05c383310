# SPDX-License-Identifier: GPL-3.0-or-later
"""A Japanese room of ten mats in the afternoon: all its light comes from outside one window.

After the "Japan" scene of Mueckl and Dachsbacher (their Fig. 9).  The window has a wooden lattice
and no paper, since paper that light shines through is more than a diffuse surface.
"""

import random

from . import architecture, furniture, kit
from .materials import Palette

LOW, HIGH = (0.0, 0.0, 0.0), (4.5, 3.6, 2.5)
WINDOW = architecture.Opening(0, -0.14, 0.0, u0=0.55, u1=3.05, z0=0.4, z1=1.8)
POST = 0.1  # side of the posts in the two northern corners (m)
BEAM_Z, BEAM_DEPTH = (1.8, 1.9), 0.025  # the beam along the walls, above window and screens

# Mats of 1.8 x 0.9 m as (low, high); no four corners meet, as is the custom.
MATS = (
    ((0.0, 0.0), (0.9, 1.8)), ((0.0, 1.8), (0.9, 3.6)),
    ((0.9, 0.0), (2.7, 0.9)), ((2.7, 0.0), (4.5, 0.9)),
    ((0.9, 0.9), (1.8, 2.7)), ((1.8, 0.9), (3.6, 1.8)),
    ((1.8, 1.8), (3.6, 2.7)), ((3.6, 0.9), (4.5, 2.7)),
    ((0.9, 2.7), (2.7, 3.6)), ((2.7, 2.7), (4.5, 3.6)),
)  # fmt: skip

SCREEN_X, SCREEN_HEIGHT = (0.55, 2.35), 1.8  # the two shoji in the north wall
SHELF_X, SHELF_SIZE = 3.35, (1.2, 0.95, 0.3)  # bookshelf at the north wall; width, height, depth
TABLE = (2.15, 1.75)
ANDON = (0.42, 3.12)  # the floor lamp
BATTENS = [(y - 0.015, y + 0.015) for y in (0.45, 0.9, 1.35, 1.8, 2.25, 2.7, 3.15)]


def build():
    kit.new_scene(400, 300)
    palette = Palette()
    rng = random.Random(9)
    _shell(palette)
    _mats(palette)
    _window(palette)
    for i in range(2):
        width = (SCREEN_X[1] - SCREEN_X[0]) / 2
        _shoji(palette, f"Shoji {i + 1}", SCREEN_X[0] + i * width, width)
    _table_and_cushions(palette)
    _along_the_wall(palette, rng)
    kit.add_camera((4.2, 0.3, 1.3), (1.55, 2.4, 0.78), lens=19.5)


def _shell(palette):
    """Plaster between posts and a beam, a ceiling of boards on battens."""
    cedar, plaster = palette["Cedar"], palette["Clay plaster"]
    (x0, y0, _), (x1, y1, height) = LOW, HIGH
    battens = [((x0, a), (x1, b)) for a, b in BATTENS]
    posts = [((x, y1 - POST), (x + POST, y1)) for x in (x0, x1 - POST)]
    architecture.room(
        "Room", LOW, HIGH, None, plaster, palette["Cedar board"],
        holes={
            "ceiling": battens + posts,
            "west": [
                ((WINDOW.u0, WINDOW.z0), (WINDOW.u1, WINDOW.z1)),
                ((y1 - POST, 0.0), (y1, height)),
                ((y0, BEAM_Z[0]), (y1, BEAM_Z[1])),
            ],
            "east": [((y1 - POST, 0.0), (y1, height))],
            "north": [
                ((x0, 0.0), (x0 + POST, height)),
                ((x1 - POST, 0.0), (x1, height)),
                ((x0, BEAM_Z[0]), (x1, BEAM_Z[1])),
                ((SCREEN_X[0], 0.0), (SCREEN_X[1], SCREEN_HEIGHT)),
            ],
        },
    )  # fmt: skip
    frame = kit.Shape()
    for (low, high), behind in zip(posts, (["west"], ["east"])):
        frame.box(
            (*low, 0.0), (*high, height), cedar, skip=["bottom", "top", "north", *behind]
        )
    frame.box(
        (x0 + POST, y1 - BEAM_DEPTH, BEAM_Z[0]), (x1 - POST, y1, BEAM_Z[1]), cedar,
        skip=["north", "west", "east"],
    )  # fmt: skip
    frame.box(
        (x0, y0, BEAM_Z[0]), (x0 + BEAM_DEPTH, y1 - POST, BEAM_Z[1]), cedar,
        skip=["west", "south", "north"],
    )  # fmt: skip
    for a, b in BATTENS:
        frame.box((x0, a, height - 0.03), (x1, b, height), cedar, skip=["top", "west", "east"])
    frame.object("Posts, beams and battens")


def _mats(palette):
    """Each mat with its two strips of cloth along the long sides; cut under what stands on it."""
    border = 0.03
    width, _, depth = SHELF_SIZE
    y1 = HIGH[1]
    footprints = [
        ((SHELF_X - width / 2, y1 - depth), (SHELF_X + width / 2, y1)),
        ((LOW[0], y1 - POST), (POST, y1)),
        ((HIGH[0] - POST, y1 - POST), (HIGH[0], y1)),
    ]
    shape = kit.Shape()
    for (x0, y0), (x1, y1) in MATS:
        if x1 - x0 > y1 - y0:
            inner = ((x0, y0 + border), (x1, y1 - border))
            strips = (((x0, y0), (x1, y0 + border)), ((x0, y1 - border), (x1, y1)))
        else:
            inner = ((x0 + border, y0), (x1 - border, y1))
            strips = (((x0, y0), (x0 + border, y1)), ((x1 - border, y0), (x1, y1)))
        shape.sheet(2, 0.0, *inner, palette["Tatami"], +1, footprints)
        for strip in strips:
            shape.sheet(2, 0.0, *strip, palette["Tatami border"], +1, footprints)
    shape.object("Tatami")


def _window(palette):
    """A lattice in the opening, and beyond it the sky as a card: the only light there is."""
    cedar = palette["Cedar"]
    architecture.window("Window frame", WINDOW, cedar, cedar, (1, 1))
    bar = architecture.FRAME
    u0, u1 = WINDOW.u0 + bar, WINDOW.u1 - bar
    z0, z1 = WINDOW.z0 + bar, WINDOW.z1 - bar
    lattice = kit.Shape()
    middle, half, columns, rows = (WINDOW.p0 + WINDOW.p1) / 2, 0.022, 6, 3
    p = (middle - half, middle + half)
    for i in range(columns):
        a, b = (u0 + (u1 - u0) * (i + k) / columns for k in (0, 1))
        a, b = (a + half if i else a), (b - half if i + 1 < columns else b)
        for j in range(1, rows):
            z = z0 + (z1 - z0) * j / rows
            WINDOW.box(lattice, (a, b), p, (z - half, z + half), cedar, skip=["-u", "+u"])
        if i + 1 < columns:
            u = b + half
            WINDOW.box(
                lattice, (u - half, u + half), p, (z0, z1), cedar, skip=["bottom", "top"]
            )
    lattice.object("Window lattice")

    sky = kit.emissive("Afternoon sky", (1.0, 0.91, 0.78), 8.0)
    low, high = (WINDOW.u0 - 0.4, WINDOW.z0 - 0.2), (WINDOW.u1 + 0.4, WINDOW.z1 + 0.4)
    kit.Shape().sheet(0, WINDOW.p0 - 0.3, low, high, sky, +1).object("Sky")


def _shoji(palette, name, x, width):
    """A sliding screen in the north wall: paper behind a lattice, and a board at its foot.

    The paper is cut into the cells of the lattice, so that none of it lies behind a bar.
    """
    cedar, paper = palette["Cedar"], palette["Shoji paper"]
    y, back, stile, foot, half = HIGH[1], HIGH[1] + 0.03, 0.04, 0.4, 0.007
    shape = kit.Shape()
    columns, rows = 3, 5
    x0, x1, z0, z1 = x + stile, x + width - stile, foot + stile, SCREEN_HEIGHT - stile

    def front(low, high, material, depth=0.0, skip=()):
        shape.box(
            (low[0], y + depth, low[1]), (high[0], back, high[1]), material,
            skip=["north", *skip],
        )  # fmt: skip

    ends = ["bottom", "top"]
    front((x, 0.0), (x0, SCREEN_HEIGHT), cedar, skip=["west", *ends])
    front((x1, 0.0), (x + width, SCREEN_HEIGHT), cedar, skip=["east", *ends])
    for low, high in ((0.0, stile), (foot, foot + stile), (z1, SCREEN_HEIGHT)):
        front((x0, low), (x1, high), cedar, skip=["west", "east"])
    shape.sheet(1, back - 0.01, (x0, stile), (x1, foot), palette["Cedar board"], -1)
    for i in range(columns):
        a, b = (x0 + (x1 - x0) * (i + k) / columns for k in (0, 1))
        a, b = (a + half if i else a), (b - half if i + 1 < columns else b)
        if i + 1 < columns:
            front((b, z0), (b + 2 * half, z1), cedar, depth=0.012, skip=ends)
        for j in range(rows):
            c, d = (z0 + (z1 - z0) * (j + k) / rows for k in (0, 1))
            c, d = (c + half if j else c), (d - half if j + 1 < rows else d)
            shape.sheet(1, back, (a, c), (b, d), paper, -1)
            if j + 1 < rows:
                front((a, d), (b, d + 2 * half), cedar, depth=0.012, skip=["west", "east"])
    shape.object(name)


def _table_and_cushions(palette):
    height = 0.34
    table = furniture.table(palette, 1.2, 0.8, height, "Walnut", leg=0.07)
    kit.place(table, "Low table", (*TABLE, 0.0))
    cushions = [
        furniture.cushion(palette[colour], (0.55, 0.55, 0.1), f"{colour} cushion")
        for colour in ("Indigo", "Brick red")
    ]
    for i, (dx, dy, turn) in enumerate(
        ((-0.15, -0.8, 0.1), (0.2, 0.82, -0.15), (-1.0, 0.05, 0.08), (1.02, -0.05, -0.2))
    ):
        at = (TABLE[0] + dx, TABLE[1] + dy, 0.0)
        kit.place(cushions[i % 2], f"Cushion {i + 1}", at, turn)
    cup = kit.Shape()
    profile = [(0.025, 0.0), (0.038, 0.07), (0.033, 0.07), (0.022, 0.012), (0.0, 0.012)]
    cup.lathe((0.0, 0.0), profile, palette["Celadon"], segments=8)
    cup = cup.mesh("Tea cup")
    for i, (dx, dy) in enumerate(((-0.1, -0.27), (0.22, 0.26), (-0.43, 0.05))):
        kit.place(cup, f"Tea cup {i + 1}", (TABLE[0] + dx, TABLE[1] + dy, height))
    pot = kit.Shape()
    body = [(0.05, 0.0), (0.085, 0.05), (0.07, 0.1), (0.03, 0.12), (0.015, 0.14), (0.0, 0.14)]
    pot.lathe((0.0, 0.0), body, palette["Dark steel"], segments=10)
    for side in (-1, 1):
        corners = [(0.075, 0.0, 0.035), (0.13, 0.0, 0.09), (0.13, side * 0.008, 0.1)]
        corners.append((0.075, side * 0.02, 0.065))
        pot.polygon(corners if side < 0 else corners[::-1], palette["Dark steel"])
    pot.object("Teapot", (TABLE[0] + 0.08, TABLE[1] + 0.02, height), 0.9)


def _along_the_wall(palette, rng):
    width, height, depth = SHELF_SIZE
    shelf = furniture.bookshelf(palette, rng, width, height, depth, boards=4, wood="Walnut")
    kit.place(shelf, "Bookshelf", (SHELF_X, HIGH[1] - depth / 2, 0.0))
    bands = (("Shoji paper", 1.2), ("Book grey", 0.8), ("Brick red", 0.12), ("Shoji paper", 2.0))
    scroll = furniture.picture(palette, 0.42, 0.66, "Indigo", bands)
    kit.place(scroll, "Scroll", (SHELF_X - 0.25, HIGH[1] - 0.004, 1.42))
    vase = kit.Shape()
    profile = [(0.05, 0.0), (0.085, 0.1), (0.03, 0.22), (0.04, 0.25), (0.03, 0.25), (0.0, 0.2)]
    vase.lathe((0.0, 0.0), profile, palette["Celadon"], segments=10)
    vase.object("Vase", (SHELF_X + 0.35, HIGH[1] - depth / 2, height))

    # A floor lamp, not lit by day: paper on four posts.
    andon = kit.Shape()
    half, post, top = 0.13, 0.012, 0.62
    for x in (-half, half - post):
        for y in (-half, half - post):
            andon.box((x, y, 0.0), (x + post, y + post, top), palette["Walnut"], skip=["bottom"])
    inner = half - post
    andon.box(
        (-inner, -inner, 0.14), (inner, inner, top - 0.02), palette["Shoji paper"], skip=["top"]
    )
    andon.object("Andon", (*ANDON, 0.0), 0.25)
