# SPDX-License-Identifier: GPL-3.0-or-later
"""Rooms, openings in walls, doors, windows and ceiling lights, for the scenes of buildings.

A room is the inside of its walls; a wall between two rooms is the space between theirs, closed by
the frames and reveals of its openings.  Surfaces meet edge to edge: walls are cut for the frames,
ceilings for the lights, floors for what stands flat on them.
"""

from dataclasses import dataclass

from . import kit

FRAME = 0.06  # width of the bars of door and window frames (m)
PROUD = 0.012  # by how much a door frame stands out of the wall (m)
SURFACES = ("floor", "ceiling", "west", "east", "south", "north")


def room(name, low, high, floor, wall, ceiling, holes=None, wall_materials=None):
    """Makes "NAME floor", "NAME walls" and "NAME ceiling", fronts towards the inside.

    low, high: inner corners.  holes: {surface: [(low, high)...]} with the two coordinates that
    vary over the surface, in their order.  wall_materials: {"west": material} for walls that
    differ from `wall`.  floor: None where the scene lays one of its own.
    """
    holes = holes or {}
    unknown = set(holes) - set(SURFACES)
    if unknown:
        raise ValueError(f"no such surfaces of a room: {sorted(unknown)}")
    wall_materials = wall_materials or {}
    (x0, y0, z0), (x1, y1, z1) = low, high
    plan = ((x0, y0), (x1, y1))
    if floor:
        kit.Shape().sheet(2, z0, *plan, floor, +1, holes.get("floor", ())).object(f"{name} floor")
    kit.Shape().sheet(2, z1, *plan, ceiling, -1, holes.get("ceiling", ())).object(
        f"{name} ceiling"
    )
    walls = kit.Shape()
    for side, axis, position, towards in (
        ("west", 0, x0, +1),
        ("east", 0, x1, -1),
        ("south", 1, y0, +1),
        ("north", 1, y1, -1),
    ):
        u0, u1 = (y0, y1) if axis == 0 else (x0, x1)
        material = wall_materials.get(side, wall)
        walls.sheet(
            axis, position, (u0, z0), (u1, z1), material, towards, holes.get(side, ())
        )
    walls.object(f"{name} walls")


@dataclass(frozen=True)
class Opening:
    """A clear rectangle through a wall that lies across `axis` (0 X, 1 Y), all in metres.

    u0..u1 runs along the wall, z0..z1 up; p0..p1 is the wall's thickness.
    """

    axis: int
    p0: float
    p1: float
    u0: float
    u1: float
    z0: float
    z1: float

    def box(self, shape, u, p, z, material, skip=()):
        """A box given along the wall, through it and up; skip: of -u +u -p +p bottom top."""
        along_x = self.axis == 1
        names = {
            "-u": "west" if along_x else "south",
            "+u": "east" if along_x else "north",
            "-p": "south" if along_x else "west",
            "+p": "north" if along_x else "east",
            "bottom": "bottom",
            "top": "top",
        }
        low, high = (u[0], p[0], z[0]), (u[1], p[1], z[1])
        if not along_x:
            low, high = (p[0], u[0], z[0]), (p[1], u[1], z[1])
        shape.box(low, high, material, skip=[names[s] for s in skip])

    def framed_hole(self):
        """What a door frame takes out of the wall: the opening and the frame's bars."""
        return ((self.u0 - FRAME, self.z0), (self.u1 + FRAME, self.z1 + FRAME))

    def hole(self):
        return ((self.u0, self.z0), (self.u1, self.z1))


def door_frame(name, opening, material, threshold):
    """Bars through the whole wall around a door opening, and the strip of floor in it."""
    o = opening
    shape = kit.Shape()
    p = (o.p0 - PROUD, o.p1 + PROUD)
    o.box(shape, (o.u0 - FRAME, o.u0), p, (o.z0, o.z1), material, skip=["bottom", "top"])
    o.box(shape, (o.u1, o.u1 + FRAME), p, (o.z0, o.z1), material, skip=["bottom", "top"])
    o.box(shape, (o.u0 - FRAME, o.u1 + FRAME), p, (o.z1, o.z1 + FRAME), material)
    low, high = (o.u0, o.p0), (o.u1, o.p1)
    if o.axis == 0:
        low, high = low[::-1], high[::-1]
    shape.sheet(2, o.z0, low, high, threshold, +1)
    return shape.object(name)


def door_leaf(width, height, leaf, metal):
    """The mesh of a door leaf from the hinge at the origin along +X, with a handle a side."""
    thickness = 0.04
    shape = kit.Shape()
    shape.box((0.0, -thickness / 2, 0.01), (width, thickness / 2, height), leaf)
    for side, behind in ((-1.0, "north"), (1.0, "south")):
        near, far = sorted((side * thickness / 2, side * (thickness / 2 + 0.045)))
        shape.box((width - 0.2, near, 1.03), (width - 0.06, far, 1.05), metal, skip=[behind])
    return shape.mesh("Door leaf")


def window(name, opening, frame, reveal, panes=(2, 1), depth=0.07):
    """Reveals through the wall and, half-way in, a frame with bars between its panes (no glass)."""
    o = opening
    shape = kit.Shape()
    # The reveal is the inside of a box, open to both sides of the wall.
    low, high = (o.u0, o.p0, o.z0), (o.u1, o.p1, o.z1)
    skip = ["south", "north"]
    if o.axis == 0:
        low, high = (o.p0, o.u0, o.z0), (o.p1, o.u1, o.z1)
        skip = ["west", "east"]
    shape.box(low, high, reveal, skip=skip, inward=True)
    centre = (o.p0 + o.p1) / 2
    p = (centre - depth / 2, centre + depth / 2)
    bar = FRAME
    o.box(shape, (o.u0, o.u0 + bar), p, (o.z0, o.z1), frame, skip=["-u", "bottom", "top"])
    o.box(shape, (o.u1 - bar, o.u1), p, (o.z0, o.z1), frame, skip=["+u", "bottom", "top"])
    inner = (o.u0 + bar, o.u1 - bar)
    o.box(shape, inner, p, (o.z0, o.z0 + bar), frame, skip=["-u", "+u", "bottom"])
    o.box(shape, inner, p, (o.z1 - bar, o.z1), frame, skip=["-u", "+u", "top"])
    columns, rows = panes
    z0, z1 = o.z0 + bar, o.z1 - bar
    slim = bar * 0.75
    for i in range(1, columns):
        u = inner[0] + (inner[1] - inner[0]) * i / columns
        o.box(shape, (u - slim / 2, u + slim / 2), p, (z0, z1), frame, skip=["bottom", "top"])
    for j in range(1, rows):
        z = z0 + (z1 - z0) * j / rows
        for i in range(columns):
            u0 = inner[0] + (inner[1] - inner[0]) * i / columns + (slim / 2 if i else 0.0)
            u1 = inner[0] + (inner[1] - inner[0]) * (i + 1) / columns
            u1 -= slim / 2 if i + 1 < columns else 0.0
            o.box(shape, (u0, u1), p, (z - slim / 2, z + slim / 2), frame, skip=["-u", "+u"])
    return shape.object(name)


def ceiling_light(name, low, high, z, glow, frame, rim=0.03, depth=0.04):
    """A light sunk into the ceiling at height z; (low, high) is also its hole in the ceiling."""
    (x0, y0), (x1, y1) = low, high
    shape = kit.Shape()
    inner = ((x0 + rim, y0 + rim), (x1 - rim, y1 - rim))
    shape.sheet(2, z, low, high, frame, -1, holes=[inner])
    shape.box(
        (*inner[0], z), (*inner[1], z + depth), frame, skip=["bottom", "top"], inward=True
    )
    shape.sheet(2, z + depth, *inner, glow, -1)
    return shape.object(name)
