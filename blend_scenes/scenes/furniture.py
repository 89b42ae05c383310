# SPDX-License-Identifier: GPL-3.0-or-later
"""Furniture as meshes: each function returns one, to be placed as often as a scene likes.

A piece stands on z = 0 with its middle over the origin unless said otherwise, its front (where one
sits, or reads the backs of the books) towards -Y.  All sizes in metres.
"""

import math

from mathutils import Matrix, Vector

from . import kit

DESK_HEIGHT = 0.74


def desk(palette, width=1.6, depth=0.8, top="Beech"):
    """A table top on two L-shaped legs, with a modesty panel behind."""
    metal, wood = palette["Steel"], palette[top]
    shape = kit.Shape()
    w, d, h = width / 2, depth / 2, DESK_HEIGHT
    shape.box((-w, -d, h - 0.028), (w, d, h), wood)
    for side in (-1, 1):
        x0, x1 = sorted((side * (w - 0.06), side * (w - 0.12)))
        shape.box((x0, -d + 0.05, 0.0), (x1, d - 0.05, 0.045), metal, skip=["bottom"])
        shape.box((x0, d - 0.25, 0.045), (x1, d - 0.17, h - 0.028), metal, skip=["bottom", "top"])
    shape.box((-w + 0.12, d - 0.11, 0.32), (w - 0.12, d - 0.092, h - 0.028), wood, skip=["top"])
    return shape.mesh("Desk")


def pedestal(palette):
    """A block of three drawers on a recessed plinth, to stand under a desk."""
    body, front, metal = palette["Light plastic"], palette["Lacquer white"], palette["Dark steel"]
    shape = kit.Shape()
    w, d, z0, z1 = 0.21, 0.27, 0.06, 0.58
    shape.box((-w, -d, z0), (w, d, z1), body, skip=["south"])
    shape.box((-w + 0.03, -d + 0.05, 0.0), (w - 0.03, d - 0.03, z0), metal, skip=["bottom", "top"])
    height = (z1 - z0 - 0.02) / 3
    lows = [z0 + 0.018 + i * height for i in range(3)]
    drawers = [((-w, low), (w, low + height - 0.016)) for low in lows]
    shape.sheet(1, -d, (-w, z0), (w, z1), body, -1, holes=drawers)
    for (x0, low), (x1, high) in drawers:
        shape.box((x0, -d - 0.016, low), (x1, -d, high), front, skip=["north"])
    return shape.mesh("Drawer pedestal")


def office_chair(palette, fabric):
    """A swivel chair: five-star base, gas lift, padded seat, leaning back."""
    cloth, black, metal = palette[fabric], palette["Black plastic"], palette["Dark steel"]
    shape = kit.Shape()
    for i in range(5):
        spoke = kit.Shape()
        spoke.box((0.04, -0.022, 0.03), (0.3, 0.022, 0.08), metal, skip=["west"])
        shape.add(spoke.transformed(Matrix.Rotation(2.0 * math.pi * i / 5.0 + 0.2, 4, "Z")))
    shape.cylinder((0.0, 0.0), 0.03, 0.03, 0.435, metal, segments=6, bottom=False, top=False)
    seat = _cushion((0.5, 0.48, 0.075), 0.06, cloth)
    shape.add(seat.transformed(Matrix.Translation((0.0, 0.0, 0.435))))
    shape.box((-0.03, 0.2, 0.405), (0.03, 0.29, 0.43), black)
    shape.box((-0.03, 0.265, 0.43), (0.03, 0.29, 0.8), black, skip=["bottom"])
    lean = Matrix.Translation((0.0, 0.2, 0.6)) @ Matrix.Rotation(math.radians(-6.0), 4, "X")
    shape.add(_cushion((0.44, 0.42, 0.055), 0.06, cloth).transformed(lean @ _UPRIGHT))
    return shape.mesh("Office chair")


# Turns what lies on z = 0 so that its top looks towards -Y and its -Y side down.
_UPRIGHT = Matrix.Translation((0.0, 0.055, 0.21)) @ Matrix.Rotation(math.radians(90.0), 4, "X")


def _cushion(size, chamfer, material):
    """A pad of size (x, y, z) on z = 0 with cut corners and a sloping upper rim."""
    w, d, h = size[0] / 2, size[1] / 2, size[2]
    c, slope = chamfer, min(0.03, h / 2)

    def loop(inset, z):
        a, b = w - inset, d - inset
        return [
            (-a + c, -b, z), (a - c, -b, z), (a, -b + c, z), (a, b - c, z),
            (a - c, b, z), (-a + c, b, z), (-a, b - c, z), (-a, -b + c, z),
        ]  # fmt: skip

    loops = [loop(slope / 2, 0.0), loop(0.0, h - slope), loop(slope, h)]
    shape = kit.Shape()
    for lower, upper in zip(loops, loops[1:]):
        for i in range(8):
            j = (i + 1) % 8
            shape.polygon((lower[i], lower[j], upper[j], upper[i]), material)
    shape.polygon(loops[-1], material)
    shape.polygon(loops[0][::-1], material)
    return shape


def monitor(palette, screen):
    """A flat screen on its stand, facing -Y; screen: the material of the picture."""
    black, metal = palette["Black plastic"], palette["Steel"]
    shape = kit.Shape()
    shape.box((-0.13, -0.06, 0.0), (0.13, 0.12, 0.014), metal, skip=["bottom"])
    shape.box((-0.03, 0.05, 0.014), (0.03, 0.075, 0.36), metal, skip=["bottom"])
    z0, z1, w, rim = 0.12, 0.47, 0.3, 0.012
    shape.box((-w, 0.01, z0), (w, 0.05, z1), black, skip=["south"])
    inner = ((-w + rim, z0 + rim), (w - rim, z1 - rim))
    shape.sheet(1, 0.01, (-w, z0), (w, z1), black, -1, holes=[inner])
    shape.sheet(1, 0.01, *inner, screen, -1)
    return shape.mesh("Monitor")


def keyboard(palette):
    """A keyboard with its keys in two blocks, as one sees them from a step away."""
    body, key = palette["Grey plastic"], palette["Light plastic"]
    shape = kit.Shape()
    w, d, top = 0.22, 0.07, 0.014
    shape.box((-w, -d, 0.0), (w, d, top), body, skip=["bottom", "top"])
    blocks = ((-0.21, 0.06), (0.08, 0.21))
    keys = [((x0, -d + 0.01), (x1, d - 0.01)) for x0, x1 in blocks]
    shape.sheet(2, top, (-w, -d), (w, d), body, +1, holes=keys)
    for low, high in keys:
        shape.box((*low, top), (*high, top + 0.008), key, skip=["bottom"])
    return shape.mesh("Keyboard")


def mouse(palette):
    """Higher at the palm than at the buttons."""
    shape, black = kit.Shape(), palette["Black plastic"]
    w, d, low, high = 0.03, 0.052, 0.014, 0.034
    side = [(-d, 0.0), (d, 0.0), (0.7 * d, high), (-d, low)]  # (y, z), counter-clockwise from +X
    for (ya, za), (yb, zb) in zip(side[1:], [*side[2:], side[0]]):
        shape.polygon(((w, ya, za), (w, yb, zb), (-w, yb, zb), (-w, ya, za)), black)
    shape.polygon([(w, y, z) for y, z in side], black)
    shape.polygon([(-w, y, z) for y, z in side[::-1]], black)
    return shape.mesh("Mouse")


def mug(palette, colour):
    """A mug with an inside and a handle."""
    shape = kit.Shape()
    glaze = palette[colour]
    profile = [(0.036, 0.0), (0.04, 0.09), (0.035, 0.09), (0.033, 0.008), (0.0, 0.008)]
    shape.lathe((0.0, 0.0), profile, glaze, segments=6)
    shape.box((0.04, -0.006, 0.03), (0.065, 0.006, 0.075), glaze, skip=["west"])
    return shape.mesh("Mug")


def desk_lamp(palette, shade):
    """A lamp, switched off, with a weighted foot, a jointed arm and a cone for a shade."""
    metal = palette["Dark steel"]
    shape = kit.Shape()
    shape.cylinder((0.0, 0.0), 0.08, 0.0, 0.02, metal, segments=8, bottom=False)
    shape.add(_bar((0.0, 0.0, 0.02), (0.0, 0.14, 0.3), 0.008, metal))
    shape.add(_bar((0.0, 0.14, 0.3), (0.0, -0.08, 0.46), 0.008, metal))
    cone = kit.Shape()
    cone.lathe((0.0, 0.0), [(0.085, -0.1), (0.03, 0.0), (0.0, 0.0)], palette[shade], segments=8)
    cone.lathe((0.0, 0.0), [(0.0, -0.008), (0.085, -0.1)], palette["White paint"], segments=8)
    tilt = Matrix.Translation((0.0, -0.09, 0.45)) @ Matrix.Rotation(math.radians(-18.0), 4, "X")
    shape.add(cone.transformed(tilt))
    return shape.mesh("Desk lamp")


def _bar(start, end, radius, material):
    """A square bar between two points."""
    start, end = Vector(start), Vector(end)
    along = end - start
    bar = kit.Shape().box((-radius, -radius, 0.0), (radius, radius, along.length), material)
    turn = along.to_track_quat("Z", "Y").to_matrix().to_4x4()
    return bar.transformed(Matrix.Translation(start) @ turn)


def book_row(rng, x0, x1, limit, y0, y1, z, tallest, colours):
    """Books side by side from x0 to at most x1, backs at y0, standing on z.

    Where two touch there is no face between them, only the strip by which one is the taller.
    One more leans on the last if there is room for it before `limit`.
    """
    shape = kit.Shape()
    books, x = [], x0
    while True:
        width = rng.uniform(0.04, 0.1)
        if x + width > x1:
            break
        books.append((x, x + width, rng.uniform(0.68, 0.97) * tallest, rng.choice(colours)))
        x += width
    heights = [0.0, *(b[2] for b in books), 0.0]
    for i, (a, b, height, cover) in enumerate(books):
        top = z + height
        shape.box((a, y0, z), (b, y1, top), cover, skip=["bottom", "north", "west", "east"])
        for x, neighbour, towards in ((a, heights[i], -1), (b, heights[i + 2], +1)):
            if height > neighbour:
                shape.sheet(0, x, (y0, z + neighbour), (y1, top), cover, towards)
    if books:
        angle, height, width = math.radians(14.0), 0.93 * books[-1][2], 0.03
        foot = books[-1][1] + height * math.sin(angle)
        if foot + width < limit:
            leaning = kit.Shape().box((0.0, y0, 0.0), (width, y1, height), rng.choice(colours))
            lean = Matrix.Translation((foot, 0.0, z)) @ Matrix.Rotation(-angle, 4, "Y")
            shape.add(leaning.transformed(lean))
    return shape


def bookshelf(palette, rng, width=0.9, height=2.0, depth=0.3, boards=5, wood="Oak", filled=0.85):
    """Shelves full of books; the plinth fills the whole footprint, so cut the floor under it."""
    timber = palette[wood]
    t, w, d = 0.022, width / 2, depth / 2
    shape = kit.Shape()
    shape.box((-w, -d, 0.0), (-w + t, d, height), timber, skip=["bottom"])
    shape.box((w - t, -d, 0.0), (w, d, height), timber, skip=["bottom"])
    inside = (-w + t, w - t)
    plinth = 0.07
    shape.box(
        (inside[0], -d + 0.03, 0.0), (inside[1], d, plinth), timber,
        skip=["bottom", "top", "west", "east"],
    )  # fmt: skip
    shape.box(
        (inside[0], d - 0.008, plinth), (inside[1], d, height), timber,
        skip=["bottom", "west", "east"],
    )  # fmt: skip
    pitch = (height - plinth - t) / (boards - 1)
    for i in range(boards):
        z = plinth + i * pitch
        shape.box(
            (inside[0], -d, z), (inside[1], d - 0.008, z + t), timber,
            skip=["west", "east", "north"],
        )  # fmt: skip
        if i < boards - 1:
            end = inside[0] + (inside[1] - inside[0]) * rng.uniform(filled - 0.3, filled)
            shape.add(
                book_row(
                    rng, inside[0], end, inside[1], -d + 0.04, d - 0.05, z + t, pitch - t - 0.03,
                    palette.books(),
                )
            )  # fmt: skip
    return shape.mesh("Bookshelf")


def binders(palette, rng, count=5):
    """Ring binders side by side along X, from the origin."""
    shape = kit.Shape()
    for i in range(count):
        cover = palette[rng.choice(("Book grey", "Book blue", "Book red", "Black plastic"))]
        x = i * 0.075
        between = (["west"] if i else []) + (["east"] if i + 1 < count else [])
        shape.box(
            (x, -0.14, 0.0), (x + 0.075, 0.14, 0.32), cover, skip=["bottom", "south", *between]
        )
        label = ((x + 0.018, 0.16), (x + 0.058, 0.27))
        shape.sheet(1, -0.14, (x, 0.0), (x + 0.075, 0.32), cover, -1, holes=[label])
        shape.sheet(1, -0.14, *label, palette["Paper"], -1)
    return shape.mesh("Binders")


def papers(palette, rng):
    """Two low stacks of A4 side by side, not quite straight."""
    shape = kit.Shape()
    for x, height in ((-0.12, 0.012), (0.12, 0.004)):
        turn = Matrix.Rotation(rng.uniform(-0.1, 0.1), 4, "Z")
        stack = kit.Shape().box(
            (-0.105, -0.148, 0.0), (0.105, 0.148, height), palette["Paper"], skip=["bottom"]
        )
        shape.add(stack.transformed(Matrix.Translation((x, 0.0, 0.0)) @ turn))
    return shape.mesh("Papers")


def plant(palette, rng, height=1.3, leaves=11):
    """A pot with soil and long leaves that bend outwards."""
    clay, green = palette["Terracotta"], palette["Leaf"]
    shape = kit.Shape()
    profile = [(0.13, 0.0), (0.18, 0.3), (0.165, 0.3), (0.16, 0.26)]
    shape.lathe((0.0, 0.0), profile, clay, segments=8)
    angles = [2.0 * math.pi * i / 8 for i in range(8)]
    shape.polygon([(0.16 * math.cos(a), 0.16 * math.sin(a), 0.26) for a in angles], palette["Soil"])
    for i in range(leaves):
        angle = 2.4 * i + rng.uniform(-0.3, 0.3)
        reach = rng.uniform(0.22, 0.45)
        top = 0.3 + (height - 0.3) * (0.4 + 0.6 * (i + 0.5) / leaves)
        droop = top - reach * rng.uniform(0.2, 0.5)
        half = rng.uniform(0.045, 0.07)
        path = [(0.07, 0.27), (0.05 + 0.55 * reach, top), (reach, droop)]
        widths = (0.006, half, 0.006)
        leaf = kit.Shape()
        for (r0, z0), (r1, z1), a, b in zip(path, path[1:], widths, widths[1:]):
            leaf.polygon(((r0, -a, z0), (r1, -b, z1), (r1, b, z1), (r0, a, z0)), green)
        shape.add(leaf.transformed(Matrix.Rotation(angle, 4, "Z")))
    return shape.mesh("Plant")


def waste_bin(palette):
    profile = [(0.11, 0.0), (0.14, 0.3), (0.135, 0.3), (0.105, 0.01), (0.0, 0.01)]
    return kit.Shape().lathe((0.0, 0.0), profile, palette["Dark steel"], segments=8).mesh("Bin")


def radiator(palette, width=1.4):
    """A panel with ribs; hangs 12 cm above the floor and 3 cm from the wall, which is at y = 0."""
    white = palette["Lacquer white"]
    shape = kit.Shape()
    z0, z1, front, count = 0.12, 0.68, -0.07, int(width / 0.25)
    shape.box((-width / 2, front, z0), (width / 2, -0.03, z1), white, skip=["south"])
    middles = [width * ((i + 0.5) / count - 0.5) for i in range(count)]
    ribs = [((x - 0.06, z0), (x + 0.06, z1)) for x in middles]
    shape.sheet(1, front, (-width / 2, z0), (width / 2, z1), white, -1, holes=ribs)
    for (x0, _), (x1, _) in ribs:
        shape.box((x0, front - 0.025, z0), (x1, front, z1), white, skip=["north"])
    return shape.mesh("Radiator")


def picture(palette, width, height, frame, colours):
    """A framed abstract picture whose back is at y = 0: bands of colour under a passe-partout."""
    shape = kit.Shape()
    w, h, bar, y = width / 2, height / 2, 0.025, -0.02
    inner = ((-w + bar, -h + bar), (w - bar, h - bar))
    shape.box((-w, y, -h), (w, 0.0, h), palette[frame], skip=["south", "north"])
    shape.sheet(1, y, (-w, -h), (w, h), palette[frame], -1, holes=[inner])
    mat = 0.06
    art = ((inner[0][0] + mat, inner[0][1] + mat), (inner[1][0] - mat, inner[1][1] - mat))
    shape.sheet(1, y, *inner, palette["Paper"], -1, holes=[art])
    total = sum(share for _, share in colours)
    z = art[0][1]
    for colour, share in colours:
        top = z + (art[1][1] - art[0][1]) * share / total
        shape.sheet(1, y, (art[0][0], z), (art[1][0], top), palette[colour], -1)
        z = top
    return shape.mesh("Picture")


def wall_clock(palette):
    """A round clock whose back is at y = 0; ten past ten."""
    shape = kit.Shape()
    face, rim, hand = palette["Paper"], palette["Black plastic"], palette["Black plastic"]
    shape.lathe((0.0, 0.0), [(0.16, 0.0), (0.16, 0.03), (0.145, 0.025)], rim, 10)
    shape.lathe((0.0, 0.0), [(0.145, 0.025), (0.0, 0.025)], face, 10)
    for angle, length, width in ((-60.0, 0.08, 0.008), (60.0, 0.115, 0.006)):
        bar = kit.Shape().box((-width, 0.0, 0.028), (width, length, 0.032), hand)
        shape.add(bar.transformed(Matrix.Rotation(math.radians(-angle), 4, "Z")))
    return shape.transformed(Matrix.Rotation(math.radians(90.0), 4, "X")).mesh("Wall clock")


def table(palette, width, depth, height, wood, leg=0.05):
    """A plain table: a top with a rail under it on four legs."""
    timber = palette[wood]
    shape = kit.Shape()
    w, d, t = width / 2, depth / 2, 0.03
    shape.box((-w, -d, height - t), (w, d, height), timber)
    for x in (-1, 1):
        for y in (-1, 1):
            x0, x1 = sorted((x * (w - 0.03), x * (w - 0.03 - leg)))
            y0, y1 = sorted((y * (d - 0.03), y * (d - 0.03 - leg)))
            shape.box((x0, y0, 0.0), (x1, y1, height - t), timber, skip=["top"])
    for y in (-1, 1):
        y0, y1 = sorted((y * (d - 0.04), y * (d - 0.06)))
        x = w - 0.03 - leg
        shape.box(
            (-x, y0, height - t - 0.08), (x, y1, height - t), timber, skip=["top", "west", "east"]
        )
    for x in (-1, 1):
        x0, x1 = sorted((x * (w - 0.04), x * (w - 0.06)))
        y = d - 0.03 - leg
        shape.box(
            (x0, -y, height - t - 0.08), (x1, y, height - t), timber,
            skip=["top", "south", "north"],
        )  # fmt: skip
    return shape.mesh("Table")


def wooden_chair(palette, wood):
    """A chair with four legs, a seat and a back of three slats; one sits facing -Y."""
    timber = palette[wood]
    shape = kit.Shape()
    w, leg, seat = 0.21, 0.04, 0.45
    shape.box((-w, -0.21, seat - 0.03), (w, 0.21, seat), timber)
    for x in (-w, w - leg):
        shape.box((x, -0.21, 0.0), (x + leg, -0.21 + leg, seat - 0.03), timber, skip=["top"])
        shape.box((x, 0.21 - leg, 0.0), (x + leg, 0.21, seat - 0.03), timber, skip=["top"])
        shape.box((x, 0.21 - leg, seat), (x + leg, 0.21, 0.92), timber, skip=["bottom"])
    for z in (0.6, 0.72, 0.84):
        shape.box(
            (-w + leg, 0.18, z), (w - leg, 0.2, z + 0.06), timber, skip=["west", "east"]
        )
    return shape.mesh("Wooden chair")


def stacking_chair(palette, fabric):
    """Seat and back between two frames of steel tube; few polygons, for rooms full of them."""
    cloth, metal = palette[fabric], palette["Dark steel"]
    shape = kit.Shape()
    w, tube, seat = 0.21, 0.024, 0.46
    for x in (-w - tube, w):
        shape.box((x, -0.2, 0.0), (x + tube, -0.2 + tube, seat), metal, skip=["bottom"])
        shape.box((x, 0.2, 0.0), (x + tube, 0.2 + tube, 0.84), metal, skip=["bottom"])
    shape.box((-w, -0.22, seat - 0.035), (w, 0.2, seat), cloth)
    shape.box((-w, 0.195, 0.56), (w, 0.225, 0.82), cloth)
    return shape.mesh("Stacking chair")


def cupboard(palette, width=0.9, height=0.8, depth=0.42, body="Lacquer white", front="Oak"):
    """A low cupboard with two doors; it fills its footprint, so cut the floor under it."""
    shape = kit.Shape()
    w, d = width / 2, depth / 2
    shape.box((-w, -d, 0.0), (w, d, height), palette[body], skip=["bottom", "south"])
    doors = [((x0, 0.06), (x1, height - 0.02)) for x0, x1 in ((-w, -0.004), (0.004, w))]
    shape.sheet(1, -d, (-w, 0.0), (w, height), palette[body], -1, holes=doors)
    for ((x0, z0), (x1, z1)), knob in zip(doors, (-0.05, 0.05)):
        shape.box((x0, -d - 0.016, z0), (x1, -d, z1), palette[front], skip=["north"])
        z = height * 0.55
        shape.box(
            (knob - 0.01, -d - 0.035, z), (knob + 0.01, -d - 0.016, z + 0.1),
            palette["Dark steel"], skip=["north"],
        )  # fmt: skip
    return shape.mesh("Cupboard")


def cushion(material, size=(0.55, 0.55, 0.09), name="Cushion"):
    """A floor cushion."""
    return _cushion(size, 0.07, material).mesh(name)
