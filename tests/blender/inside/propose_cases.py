# SPDX-License-Identifier: GPL-3.0-or-later
"""Mid-planes of hand-made walls.

Result: {CASE: [plane] or a list of such}, the largest plane first, with its triangles as Blender
makes them of its polygons, and points all over it; of "random_blocks" figures only.
"""

import pathlib
import sys

import bpy
import numpy as np
from mathutils import Euler

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402

wall_planes = recorder.addon("wall_planes")


def surface(boxes, holes=(), outside=True):
    """(q, 4, 3) Quads of the surface of boxes (low, high) less holes, counter-clockwise as seen
    from the open. outside: whether light is there, not in the holes only."""
    breaks = [np.unique([corner[axis] for box in (*boxes, *holes) for corner in box])
              for axis in range(3)]
    breaks = [np.array([b[0] - 1, *b, b[-1] + 1], float) for b in breaks]
    middles = np.stack(np.meshgrid(*((b[1:] + b[:-1]) / 2 for b in breaks), indexing="ij"), axis=-1)

    def within(some):
        return np.any([((middles > low) & (middles < high)).all(axis=-1) for low, high in some],
                      axis=0)

    hollow = within(holes) if len(holes) else np.zeros(middles.shape[:3], bool)
    full = within(boxes) & ~hollow
    lit = ~full if outside else hollow
    quads = []
    for axis, step in enumerate(np.eye(3, dtype=int)):
        for cell in np.argwhere(np.ones(np.array(full.shape) - step)):
            here, there = tuple(cell), tuple(cell + step)
            if not (full[here] and lit[there] or lit[here] and full[there]):
                continue
            quad = np.empty((4, 3))
            quad[:, axis] = breaks[axis][cell[axis] + 1]
            for other, steps in ((axis + 1) % 3, (0, 1, 1, 0)), ((axis + 2) % 3, (0, 0, 1, 1)):
                quad[:, other] = breaks[other][cell[other] + np.array(steps)]
            quads.append(quad if full[here] else quad[::-1])
    return np.array(quads)


def triangulated(quads, cuts=1, seed=None):
    """(t, 3, 3) Each quad cut into cuts x cuts, those along a diagonal, at random with a seed."""
    random = None if seed is None else np.random.default_rng(seed)
    shares = np.linspace(0, 1, cuts + 1)
    triangles = []
    for a, b, c, d in quads:
        for s0, s1 in zip(shares, shares[1:]):
            for t0, t1 in zip(shares, shares[1:]):
                q = [(1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * d + s * c)
                     for s, t in ((s0, t0), (s1, t0), (s1, t1), (s0, t1))]
                if random is not None and random.random() < 0.5:
                    q = q[1:] + q[:1]
                triangles += [(q[0], q[1], q[2]), (q[0], q[2], q[3])]
    return np.array(triangles)


def lit(triangles, front=True, back=False):
    """As the core's lit_sides() gives it."""
    count = len(triangles)
    return {"corners": np.asarray(triangles, np.float32).reshape(-1, 3, 3),
            "front": np.full(count, front), "back": np.full(count, back),
            "objects": ["Wall"] * count}


def joined(*some):
    return {"objects": sum((sides["objects"] for sides in some), []),
            **{key: np.concatenate([sides[key] for sides in some])
               for key in ("corners", "front", "back")}}


def found(sides, **settings):
    return [{"triangles": tessellated(plane), "polygons": len(plane.faces), "area": plane.area,
             "own_triangles": plane.vertices[plane.triangles], "points": plane.sample(400),
             "centre": plane.centre, "normal": plane.normal}
            for plane in wall_planes.find_planes(sides, **settings)]


def tessellated(plane):
    mesh = bpy.data.meshes.new("Plane")
    mesh.from_pydata(plane.vertices.tolist(), [], plane.faces)
    mesh.calc_loop_triangles()
    points = np.array([vertex.co for vertex in mesh.vertices])
    triangles = points[[triangle.vertices[:] for triangle in mesh.loop_triangles]]
    bpy.data.meshes.remove(mesh)
    return triangles


# 4 m long, 0.2 m thick, 2.6 m high
WALL = ((0, 0, 0), (4, 0.2, 2.6))
DOOR = ((1, -1, 0), (1.9, 1, 2.05))
WINDOW = ((2.5, -1, 0.9), (3.5, 1, 2.1))
SLOT = ((1, -1, 0.5), (1.3, 1, 2.0))  # narrower than the thickness of what counts as a wall
ASKEW = np.array(Euler((0.3, 0.5, 0.7)).to_matrix())
SHEET = np.array([[(0, 0, 0), (3, 0, 0), (3, 0, 2), (0, 0, 2)]], float)


def box_wall():
    return found(lit(triangulated(surface([WALL]))))


def finely_triangulated():
    return found(lit(triangulated(surface([WALL]), cuts=9, seed=1)))


def flipped():
    """Half of the triangles turn their backs to the light."""
    triangles = triangulated(surface([WALL]), cuts=4, seed=1)
    odd = np.arange(len(triangles)) % 2 == 1
    triangles[odd] = triangles[odd][:, ::-1]
    return found({**lit(triangles), "front": ~odd, "back": odd})


def tilted():
    triangles = triangulated(surface([WALL], [DOOR, WINDOW]), cuts=3, seed=2)
    return found(lit(triangles @ ASKEW.T + (20, -30, 10)))


def lit_from_one_side():
    sides = lit(triangulated(surface([WALL])))
    return found({**sides, "front": sides["corners"][..., 1].max(axis=1) < 0.1})


def panel_on_a_wall():
    """Only its front is lit; the wall's face goes on behind it."""
    panel = np.array([[(1, -0.1, 1), (2, -0.1, 1), (2, -0.1, 2), (1, -0.1, 2)]], float)
    return found(joined(lit(triangulated(surface([WALL]))), lit(triangulated(panel))))


def pilaster():
    """Where it stands, the wall is thicker and its middle elsewhere."""
    return found(lit(triangulated(surface([WALL, ((1.8, 0.2, 0), (2.2, 0.24, 2.6))]))))


def openings():
    return found(lit(triangulated(surface([WALL], [DOOR, WINDOW]), cuts=3, seed=2)))


def slot():
    return found(lit(triangulated(surface([WALL], [SLOT]))))


def slots_that_see_dark_sides():
    """Panels before and behind, which count as unlit: so within the slot most sides are, as within
    matter. In the second wall no lit side crosses the middle, where its reveals have an edge."""
    panels = [np.array([(-5, y, -5), (9, y, -5), (9, y, 9), (-5, y, 9)]) for y in (-0.3, 0.5)]
    halves = [((0, 0, 0), (4, 0.1, 2.6)), ((0, 0.1, 0), (4, 0.2, 2.6))]
    return [found(joined(lit(triangulated(surface(boxes, [SLOT]))),
                         lit(triangulated(panels), front=False))) for boxes in ([WALL], halves)]


def slot_in_a_sheet():
    """No reveals; what tells is that lit walls are seen from within the slot."""
    low, high = SLOT
    cells = surface([((0, 0, 0), (3, 1, 2.6))], [((low[0], 0, low[2]), (high[0], 1, high[2]))])
    cells = cells[(cells[..., 1] == 0).all(axis=1)]
    room = surface([((-3, -4, -1), (6, 4, 4))], [((-2, -3, 0), (5, 3, 2.6))], outside=False)
    return found(joined(lit(triangulated(cells), back=True), lit(triangulated(room))))


def niche():
    """A hole in one of the faces only."""
    return found(lit(triangulated(surface([WALL], [((1, -1, 0.5), (2, 0.1, 1.5))]))), min_area=2.0)


def sheet():
    return found(lit(triangulated(SHEET, cuts=3, seed=1), back=True))


def back_to_back_sheets():
    """Each lit from its side only, 1 mm apart or in one another."""
    return [found(joined(lit(triangulated(SHEET)),
                         lit(triangulated(SHEET[:, ::-1] + (0, apart, 0)))))
            for apart in (0.001, 0.0, -0.001)]


def air_gap():
    return found(lit(triangulated(surface([((0, 0, 0), (4, 0.1, 2.6)),
                                           ((0, 0.3, 0), (4, 0.4, 2.6))]))), min_area=1.0)


def dark_air_gap():
    low, high = np.array([(0, 0, 0), (4, 0, 0), (4, 0, 2.6), (0, 0, 2.6)]), np.array((0, 0.4, 0))
    return found(lit(triangulated([low, (low + high)[::-1]])))


def thickness():
    sides = lit(triangulated(surface([WALL])))
    return [found(sides, thickness=limit) for limit in (0.19, 0.2)]


def smallest_area():
    sides = lit(triangulated(surface([((0, 0, 0.7), (1, 0.5, 0.74))])))
    return [found(sides, min_area=limit) for limit in (0.51, 0.49)]


def l_shape():
    return found(lit(triangulated(surface([WALL, ((0, 0.2, 0), (0.2, 3, 2.6))]))))


CORRIDOR = ((0, 0, 0), (6, 2, 2.6))
NORTH = (((0, 2.2, 0), (2.9, 5, 2.6)), ((3.06, 2.2, 0), (6, 5, 2.6)))
SOUTH = (((0, -1, 0), (2.9, 2, 2.6)), ((3.06, -1, 0), (6, 2, 2.6)))


def rooms(*hollow):
    """Rooms and doors in a block outside of which it is dark."""
    return surface([((-1, -5, -1), (7, 6, 3.6))], hollow, outside=False)


def t_junction():
    return found(lit(triangulated(rooms(CORRIDOR, *NORTH))))


def t_junction_between_slabs():
    """One floor and one ceiling for all, which go on below and above the walls."""
    quads = rooms(CORRIDOR, *NORTH)
    level = (quads[..., 2] == quads[:, :1, 2]).all(axis=1)
    floor = np.array([(0, 0, 0), (6, 0, 0), (6, 5, 0), (0, 5, 0)], float)
    return found(lit(triangulated([*quads[~level], floor, floor[::-1] + (0, 0, 2.6)])))


def crossing():
    return found(lit(triangulated(rooms(*NORTH, *SOUTH))))


def doors_beside_a_junction():
    """Less than half a metre from one to the other, and either narrower than that."""
    doors = ((2.45, 1.9, 0), (2.85, 2.3, 2.05)), ((3.11, 1.9, 0), (3.5, 2.3, 2.05))
    return found(lit(triangulated(rooms(CORRIDOR, *NORTH, *doors))))


def storeys():
    return found(lit(triangulated(surface(
        [((-1, -1, -1), (6, 5, 7))], [((0, 0, 0), (5, 4, 2.6)), ((0, 0, 2.9), (5, 4, 5.5))],
        outside=False))))


def drift():
    """Steps of 1.5 mm on one face: neighbours are within the tolerance, the first and last not."""
    quads = [np.array([(i, 0.0015 * i, 0), (i + 1, 0.0015 * i, 0), (i + 1, 0.0015 * i, 2),
                       (i, 0.0015 * i, 2)]) for i in range(6)]
    back = np.array([(0, 0.2, 0), (0, 0.2, 2), (6, 0.2, 2), (6, 0.2, 0)])
    return found(lit(triangulated([*quads, back])))


def random_blocks():
    """[(planes, points of them, points that stick out of the matter by more than 1 mm)]"""
    results = []
    for seed in range(40):
        random = np.random.default_rng(seed)
        low = random.integers(0, 20, (9, 3)) / 10
        blocks = np.stack([low, low + random.integers(1, 16, (9, 3)) / 10], axis=1)
        boxes, holes = blocks[:7], blocks[7:]
        triangles = triangulated(surface(boxes, holes), cuts=1 + seed % 3, seed=seed)
        turn = ASKEW if seed % 2 else np.eye(3)
        planes = wall_planes.find_planes(lit(triangles @ turn.T), min_area=0.1)
        points = np.concatenate([plane.sample(300) for plane in planes]) @ turn
        within = [((points > low - margin) & (points < high + margin)).all(axis=1)
                  for margin, some in ((0.001, boxes), (-0.001, holes)) for low, high in some]
        solid = np.any(within[:7], axis=0) & ~np.any(within[7:], axis=0)
        results.append((len(planes), len(points), int((~solid).sum())))
    return results


def nothing():
    degenerate = np.zeros((3, 3, 3))
    return [found(lit(triangles)) for triangles in (degenerate[:0], degenerate)]


recorder.finish({name: case() for name, case in list(globals().items())
                 if getattr(case, "__module__", "") == "__main__" and name not in (
                     "surface", "triangulated", "lit", "joined", "found", "tessellated", "rooms")})
