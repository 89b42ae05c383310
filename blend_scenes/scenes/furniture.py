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
    """A table top on two C-shaped frames, with a modesty panel and a cable tray behind."""
    metal, wood = palette["Steel"], palette[top]
    shape = kit.Shape()
    w, d, h = width / 2, depth / 2, DESK_HEIGHT
    shape.box((-w, -d, h - 0.028), (w, d, h), wood)
    for side in (-1, 1):
        x0, x1 = sorted((side * (w - 0.06), side * (w - 0.12)))
        shape.box((x0, -d + 0.05, 0.0), (x1, d - 0.05, 0.045), metal, skip=["bottom"])
        shape.box((x0, d - 0.25, 0.045), (x1, d - 0.17, h - 0.07), metal, skip=["bottom", "top"])
        shape.box((x0, -d + 0.12, h - 0.07), (x1, d - 0.08, h - 0.028), metal, skip=["top"])
    shape.box((-w + 0.12, d - 0.11, 0.32), (w - 0.12, d - 0.092, h - 0.028), wood, skip=["top"])
    shape.box((-w + 0.3, d - 0.32, h - 0.14), (w - 0.3, d - 0.2, h - 0.1), metal)
    return shape.mesh("Desk")


def pedestal(palette):
    """A block of three drawers on castors, to stand under a desk."""
    body, front, metal = palette["Light plastic"], palette["Lacquer white"], palette["Dark steel"]
    shape = kit.Shape()
    w, d, z0, z1 = 0.21, 0.27, 0.06, 0.58
    shape.box((-w, -d, z0), (w, d, z1), body)
    for x in (-w + 0.04, w - 0.04):
        for y in (-d + 0.05, d - 0.05):
            shape.box((x - 0.02, y - 0.02, 0.0), (x + 0.02, y + 0.02, z0), metal, skip=["top"])
    height = (z1 - z0 - 0.02) / 3
    for i in range(3):
        low = z0 + 0.01 + i * height
        shape.box(
            (-w + 0.006, -d - 0.016, low + 0.004), (w - 0.006, -d, low + height - 0.004), front,
            skip=["north"],
        )  # fmt: skip
        shape.box(
            (-0.07, -d - 0.03, low + height - 0.05), (0.07, -d - 0.016, low + height - 0.035),
            metal, skip=["north"],
        )  # fmt: skip
    return shape.mesh("Drawer pedestal")


def office_chair(palette, fabric):
    """A swivel chair: five-star base on castors, gas lift, padded seat, curved back, armrests."""
    cloth, black, metal = palette[fabric], palette["Black plastic"], palette["Dark steel"]
    shape = kit.Shape()
    for i in range(5):
        spoke = kit.Shape()
        spoke.box((0.03, -0.022, 0.07), (0.3, 0.022, 0.1), metal, skip=["west"])
        spoke.cylinder((0.28, 0.0), 0.028, 0.0, 0.07, black, segments=6, top=False)
        shape.add(spoke.transformed(Matrix.Rotation(2.0 * math.pi * i / 5.0 + 0.2, 4, "Z")))
    shape.cylinder((0.0, 0.0), 0.045, 0.06, 0.13, metal)
    shape.cylinder((0.0, 0.0), 0.025, 0.13, 0.41, metal, bottom=False, top=False)
    shape.box((-0.12, -0.12, 0.41), (0.12, 0.12, 0.435), black)
    shape.add(_cushion((0.5, 0.48, 0.075), 0.06, cloth).transformed(Matrix.Translation((0, 0, 0.435))))
    # The back: three upright strips that follow a shallow arc, on a bent bar.
    for x0, x1, ya, yb in ((-0.22, -0.08, 0.17, 0.22), (-0.08, 0.08, 0.22, 0.22), (0.08, 0.22, 0.22, 0.17)):
        _slanted_strip(shape, x0, x1, ya, yb, 0.58, 1.02, 0.05, cloth)
    shape.box((-0.03, 0.1, 0.4), (0.03, 0.29, 0.435), black, skip=["south"])
    shape.box((-0.03, 0.27, 0.435), (0.03, 0.3, 0.85), black, skip=["bottom"])
    for side in (-1, 1):
        x0, x1 = sorted((side * 0.25, side * 0.285))
        shape.box((x0, -0.02, 0.45), (x1, 0.06, 0.66), black, skip=["top"])
        x0, x1 = sorted((side * 0.235, side * 0.3))
        shape.box((x0, -0.15, 0.66), (x1, 0.13, 0.685), black)
    return shape.mesh("Office chair")


def _slanted_strip(shape, x0, x1, ya, yb, z0, z1, thickness, material):
    """An upright slab whose front runs from (x0, ya) to (x1, yb), leaning back by 5 cm."""
    lean, t = 0.05, thickness
    front = [(x0, ya, z0), (x1, yb, z0), (x1, yb + lean, z1), (x0, ya + lean, z1)]
    back = [(x, y + t, z) for x, y, z in front]
    shape.polygon(front, material)
    shape.polygon(back[::-1], material)
    for i in range(4):
        j = (i + 1) % 4
        shape.polygon((front[j], front[i], back[i], back[j]), material)


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

    loops = [loop(slope / 2, 0.0), loop(0.0, slope / 2), loop(0.0, h - slope), loop(slope, h)]
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
    """A keyboard with its keys in blocks, as one sees them from a step away."""
    body, key = palette["Grey plastic"], palette["Light plastic"]
    shape = kit.Shape()
    w, d, top = 0.22, 0.07, 0.014
    shape.box((-w, -d, 0.0), (w, d, top), body, skip=["bottom"])
    blocks = ((-0.21, -0.135), (-0.13, -0.04), (-0.035, 0.06), (0.065, 0.13), (0.14, 0.21))
    for row in range(5):
        y = -d + 0.012 + row * 0.024
        for x0, x1 in blocks:
            shape.box((x0, y, top), (x1, y + 0.02, top + 0.008), key, skip=["bottom"])
    return shape.mesh("Keyboard")


def mouse(palette):
    shape = kit.Shape()
    shape.add(_cushion((0.062, 0.105, 0.034), 0.02, palette["Black plastic"]))
    return shape.mesh("Mouse")


def mug(palette, colour):
    """A mug with an inside and a handle."""
    shape = kit.Shape()
    glaze = palette[colour]
    profile = [(0.036, 0.0), (0.04, 0.09), (0.036, 0.09), (0.033, 0.008), (0.0, 0.008)]
    shape.lathe((0.0, 0.0), profile, glaze, segments=10)
    for z0, z1 in ((0.02, 0.03), (0.065, 0.075)):
        shape.box((0.036, -0.006, z0), (0.066, 0.006, z1), glaze, skip=["west"])
    shape.box((0.056, -0.006, 0.03), (0.066, 0.006, 0.065), glaze, skip=["bottom", "top"])
    return shape.mesh("Mug")


def desk_lamp(palette, shade, glow):
    """A lamp with a weighted foot, a jointed arm and a cone of a shade with a glowing disk in it."""
    metal = palette["Dark steel"]
    shape = kit.Shape()
    shape.cylinder((0.0, 0.0), 0.08, 0.0, 0.02, metal, segments=10, bottom=False)
    shape.add(_bar((0.0, 0.0, 0.02), (0.0, 0.14, 0.3), 0.008, metal))
    shape.add(_bar((0.0, 0.14, 0.3), (0.0, -0.08, 0.46), 0.008, metal))
    cone = kit.Shape()
    outer = [(0.085, -0.1), (0.035, 0.02), (0.0, 0.02)]
    inner = [(0.03, 0.012), (0.08, -0.1), (0.085, -0.1)]
    cone.lathe((0.0, 0.0), outer, palette[shade], segments=12)
    cone.lathe((0.0, 0.0), inner, palette["White paint"], segments=12)
    cone.lathe((0.0, 0.0), [(0.0, -0.05), (0.03, -0.05), (0.03, -0.03), (0.0, -0.03)], glow, 8)
    tilt = Matrix.Translation((0.0, -0.08, 0.45)) @ Matrix.Rotation(math.radians(-18.0), 4, "X")
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
        width = rng.uniform(0.018, 0.05)
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
        x = i * 0.078
        shape.box((x, -0.14, 0.0), (x + 0.075, 0.14, 0.32), cover, skip=["bottom"])
        label = ((x + 0.018, 0.16), (x + 0.058, 0.27))
        shape.sheet(1, -0.1405, *label, palette["Paper"], -1)
    return shape.mesh("Binders")


def papers(palette, rng, sheets=4):
    """Sheets of A4 lying askew on each other."""
    shape = kit.Shape()
    for i in range(sheets):
        turn = Matrix.Rotation(rng.uniform(-0.25, 0.25), 4, "Z")
        shift = Matrix.Translation((rng.uniform(-0.02, 0.02), rng.uniform(-0.02, 0.02), i * 0.003))
        sheet = kit.Shape().box(
            (-0.105, -0.148, 0.0), (0.105, 0.148, 0.003), palette["Paper"], skip=["bottom"]
        )
        shape.add(sheet.transformed(shift @ turn))
    return shape.mesh("Papers")


def plant(palette, rng, height=1.3, leaves=36):
    """A pot with soil and long leaves that bend outwards."""
    clay, green = palette["Terracotta"], palette["Leaf"]
    shape = kit.Shape()
    profile = [(0.13, 0.0), (0.18, 0.3), (0.165, 0.3), (0.16, 0.26)]
    shape.lathe((0.0, 0.0), profile, clay, segments=12)
    shape.lathe((0.0, 0.0), [(0.16, 0.26), (0.0, 0.27)], palette["Soil"], segments=12)
    for i in range(leaves):
        angle = 2.4 * i + rng.uniform(-0.3, 0.3)
        reach = rng.uniform(0.15, 0.5)
        top = 0.3 + (height - 0.3) * rng.uniform(0.45, 1.0)
        droop = top - reach * rng.uniform(0.2, 0.6)
        half = rng.uniform(0.025, 0.045)
        path = [(0.03, 0.27), (0.3 * reach + 0.03, 0.6 * top + 0.1), (0.75 * reach, top), (reach, droop)]
        widths = (0.006, half, half, 0.004)
        leaf = kit.Shape()
        for (r0, z0), (r1, z1), a, b in zip(path, path[1:], widths, widths[1:]):
            leaf.polygon(((r0, -a, z0), (r1, -b, z1), (r1, b, z1), (r0, a, z0)), green)
        shape.add(leaf.transformed(Matrix.Rotation(angle, 4, "Z")))
    return shape.mesh("Plant")


def waste_bin(palette):
    profile = [(0.11, 0.0), (0.14, 0.3), (0.135, 0.3), (0.105, 0.01), (0.0, 0.01)]
    return kit.Shape().lathe((0.0, 0.0), profile, palette["Dark steel"], segments=14).mesh("Bin")


def radiator(palette, width=1.4):
    """Fins between two rails; hangs 12 cm above the floor, its back at y = 0."""
    white = palette["Lacquer white"]
    shape = kit.Shape()
    count = int(width / 0.075)
    shape.box((-width / 2, -0.085, 0.16), (width / 2, -0.045, 0.2), white)
    shape.box((-width / 2, -0.085, 0.6), (width / 2, -0.045, 0.64), white)
    for i in range(count):
        x = -width / 2 + 0.02 + i * (width - 0.075) / (count - 1)
        shape.box((x, -0.1, 0.12), (x + 0.035, -0.03, 0.68), white)
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
    shape.lathe((0.0, 0.0), [(0.16, 0.0), (0.16, 0.04), (0.145, 0.04), (0.145, 0.025)], rim, 20)
    shape.lathe((0.0, 0.0), [(0.145, 0.025), (0.0, 0.025)], face, 20)
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


def cupboard(palette, width=0.9, height=0.8, depth=0.42, body="Lacquer white", front="Oak"):
    """A low cupboard with two doors; it fills its footprint, so cut the floor under it."""
    shape = kit.Shape()
    w, d = width / 2, depth / 2
    shape.box((-w, -d, 0.0), (w, d, height), palette[body], skip=["bottom"])
    for x0, x1, knob in ((-w + 0.01, -0.003, -0.05), (0.003, w - 0.01, 0.05)):
        shape.box(
            (x0, -d - 0.016, 0.06), (x1, -d, height - 0.02), palette[front], skip=["north"]
        )
        shape.box(
            (knob - 0.01, -d - 0.035, height * 0.55), (knob + 0.01, -d - 0.016, height * 0.55 + 0.1),
            palette["Dark steel"], skip=["north"],
        )  # fmt: skip
    return shape.mesh("Cupboard")


def cushion(material, size=(0.55, 0.55, 0.09), name="Cushion"):
    """A floor cushion."""
    return _cushion(size, 0.07, material).mesh(name)


def coat_stand(palette):
    wood = palette["Walnut"]
    shape = kit.Shape()
    shape.cylinder((0.0, 0.0), 0.2, 0.0, 0.025, wood, segments=12, bottom=False)
    shape.cylinder((0.0, 0.0), 0.02, 0.025, 1.75, wood, bottom=False)
    for i in range(4):
        turn = Matrix.Rotation(math.pi / 2 * i + 0.4, 4, "Z")
        shape.add(_bar((0.015, 0.0, 1.6), (0.14, 0.0, 1.72), 0.01, wood).transformed(turn))
    return shape.mesh("Coat stand")
