# SPDX-License-Identifier: GPL-3.0-or-later
"""Blocking planes of hand-made walls. Result: {CASE: {"planes": [...], ...}}, where a plane is what
wall_planes found and the triangles that Blender makes of its polygons.
"""

import pathlib
import sys

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402

wall_planes = recorder.addon("wall_planes")


def solid(boxes, holes=(), dark=()):
    """(q, 4, 3) Quads of the surface of boxes (low, high) without holes, counter-clockwise as seen
    from the open. No quads are made towards `dark`, boxes that no light reaches."""
    breaks = [np.unique([corner[axis] for box in (*boxes, *holes, *dark) for corner in box])
              for axis in range(3)]
    breaks = [np.array([b[0] - 1, *b, b[-1] + 1]) for b in breaks]
    middles = np.stack(np.meshgrid(*((b[1:] + b[:-1]) / 2 for b in breaks), indexing="ij"), axis=-1)

    def within(some):
        inside = np.zeros(middles.shape[:3], bool)
        for low, high in some:
            inside |= ((middles > low) & (middles < high)).all(axis=-1)
        return inside

    full, unlit = within(boxes) & ~within(holes), within(dark)
    quads = []
    for axis in range(3):
        others = [(axis + 1) % 3, (axis + 2) % 3]
        for index in np.argwhere(np.ones(np.array(full.shape) - np.eye(3, dtype=int)[axis])):
            here, there = tuple(index), tuple(index + np.eye(3, dtype=int)[axis])
            if full[here] == full[there] or unlit[here] or unlit[there]:
                continue
            corners = np.empty((4, 3))
            corners[:, axis] = breaks[axis][index[axis] + 1]
            for other, steps in zip(others, ([0, 1, 1, 0], [0, 0, 1, 1])):
                corners[:, other] = breaks[other][index[other] + np.array(steps)]
            quads.append(corners if full[here] else corners[::-1])
    return np.array(quads)


def triangulated(quads, rng=None, cuts=1):
    """(t, 3, 3) Each quad cut into cuts x cuts, and those along a diagonal; with `rng` one at
    random."""
    triangles = []
    shares = np.linspace(0, 1, cuts + 1)
    for a, b, c, d in quads:
        for s0, s1 in zip(shares, shares[1:]):
            for t0, t1 in zip(shares, shares[1:]):
                q = [(1 - s) * ((1 - t) * a + t * d) + s * ((1 - t) * b + t * c)
                     for s, t in ((s0, t0), (s1, t0), (s1, t1), (s0, t1))]
                if rng is not None and rng.random() < 0.5:
                    q = q[1:] + q[:1]
                triangles += [(q[0], q[1], q[2]), (q[0], q[2], q[3])]
    return np.array(triangles)


def lit(triangles, back=False):
    """As the core's lit_sides() has it: lit from in front, or from both sides."""
    count = len(triangles)
    return {"corners": np.asarray(triangles, np.float32), "front": np.ones(count, bool),
            "back": np.full(count, back), "objects": ["Wall"] * count}


def found(sides, **settings):
    planes = wall_planes.find_planes(sides, **settings)
    return {"planes": [{"triangles": tessellated(plane), "faces": len(plane.faces),
                        "centre": plane.centre, "normal": plane.normal, "area": plane.area}
                       for plane in planes]}


def tessellated(plane):
    mesh = bpy.data.meshes.new("Plane")
    mesh.from_pydata(plane.vertices.tolist(), [], plane.faces)
    mesh.calc_loop_triangles()
    points = np.array([vertex.co for vertex in mesh.vertices])
    triangles = points[[triangle.vertices for triangle in mesh.loop_triangles]]
    bpy.data.meshes.remove(mesh)
    return triangles


WALL = ((0, 0, 0), (4, 0.2, 2.6))
DOOR = ((1, -1, 0), (1.9, 1, 2.05))
WINDOW = ((2.5, -1, 0.9), (3.5, 1, 2.1))


def box_wall():
    return found(lit(triangulated(solid([WALL]))))


def finely_triangulated():
    return found(lit(triangulated(solid([WALL]), np.random.default_rng(1), cuts=9)))


def openings():
    return found(lit(triangulated(solid([WALL], [DOOR, WINDOW]), np.random.default_rng(2), cuts=3)))


def t_junction():
    return found(lit(triangulated(solid([WALL, ((2, 0.2, 0), (2.16, 4, 2.6))]))))


def l_shape():
    return found(lit(triangulated(solid([WALL, ((0, 0.2, 0), (0.2, 3, 2.6))]))))


def crossing():
    return found(lit(triangulated(solid([WALL, ((2, -3, 0), (2.16, 4, 2.6))]))))


recorder.finish({name: case() for name, case in list(globals().items())
                 if callable(case) and getattr(case, "__module__", "") == "__main__"
                 and case.__code__.co_argcount == 0})
