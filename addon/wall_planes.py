# SPDX-License-Identifier: GPL-3.0-or-later
"""Walls -> the planes in their middle. Geometry only: arrays in, arrays out.

Light reaches a wall from both of its sides, or it need not be blocked; between its two faces it
reaches nothing. So a wall is where a lit side has, as the nearest lit side behind it, one that
looks the other way. "Lit side": the side of a triangle that light reaches, with its outward normal.
"""
from dataclasses import dataclass, field

import bmesh
import numpy as np

from . import planar
from .wall_junctions import close_junctions

THICKNESS = 0.5  # m, of the thickest wall, by default
MIN_AREA = 0.25  # m2, of the smallest plane, by default
PARALLEL = np.cos(np.radians(1.0))
COPLANAR = 0.002  # m, from the plane of the largest triangle
# m2: what is less of a face, all in all, makes no wall and hides none.
SMALLEST_FACE = 0.05
NARROWEST = 0.01  # m, of a plane
MOST_PLANES = 500  # the largest: a facetted dome has thousands, of which each blocks little
FLAT = 1e-3  # rad, where faces and edges of the result are joined
SAME_AREA = 1e-3  # relative


@dataclass
class LitSides:
    corners: np.ndarray  # (s, 3, 3) m, counter-clockwise as seen from the lit side
    normals: np.ndarray  # (s, 3) outward
    areas: np.ndarray    # (s,) m2


@dataclass
class Face:
    """Coplanar lit sides that look the same way, in the frame of their family of parallel ones."""
    looks_up: bool          # along the frame's normal, or against it
    slope: np.ndarray       # (3,): height = slope . (1, u, v)
    outline: np.ndarray     # (e, 2, 2) of planar.outline()
    box: np.ndarray = field(init=False)  # (2, 2) lowest and highest u, v

    def __post_init__(self):
        self.box = np.array([self.outline.min(axis=(0, 1)), self.outline.max(axis=(0, 1))])

    def height(self, points):
        return height_on(self.slope, points)


@dataclass
class MidPlane:
    """What lies in one plane halfway between faces."""
    frame: planar.Frame
    slope: np.ndarray      # as Face's
    triangles: np.ndarray  # (t, 3, 2) of planar.united()

    def height(self, points):
        return height_on(self.slope, points)

    def to_world(self, points):
        return self.frame.to_world(points, self.height(points))

    @property
    def normal(self):
        normal = np.array([-self.slope[1], -self.slope[2], 1.0]) @ self.frame.axes
        return normal / np.linalg.norm(normal)


@dataclass
class BlockingPlane:
    vertices: np.ndarray    # (v, 3) m, world space
    faces: list[list[int]]  # polygons
    triangles: np.ndarray   # (t, 3) i32, of the polygons
    centre: np.ndarray      # (3,)
    normal: np.ndarray      # (3,)
    area: float             # m2

    def sample(self, count):
        """(count, 3) Points all over it, the same whenever asked."""
        random = np.random.default_rng(0)
        corners = self.vertices[self.triangles]
        weights = planar.areas(corners)
        chosen = corners[random.choice(len(corners), count, p=weights / weights.sum())]
        a, b = np.sqrt(random.random((count, 1))), random.random((count, 1))
        return chosen[:, 0] * (1 - a) + chosen[:, 1] * a * (1 - b) + chosen[:, 2] * a * b


def height_on(slope, points):
    return slope[0] + points @ slope[1:]


def find_planes(lit, thickness=THICKNESS, min_area=MIN_AREA) -> list[BlockingPlane]:
    """The largest first. lit: what the core's lit_sides() returns"""
    sides = lit_sides_of(lit)
    planes = []
    for family in families(sides, 2 * min_area):
        planes += mid_planes(faces_of(sides, family), thickness + COPLANAR)
    areas = np.array([planar.areas(plane.triangles).sum() for plane in planes])
    largest = np.argsort(-areas)[:MOST_PLANES]
    planes = close_junctions([planes[i] for i in largest if areas[i] >= min_area], lit, thickness)
    found = [finish(plane, part) for plane in planes for part in planar.connected(plane.triangles)
             if is_substantial(part, min_area)]
    return sorted(found, key=lambda plane: -plane.area)


def lit_sides_of(lit) -> LitSides:
    corners = lit["corners"].astype(float)
    corners = np.concatenate([corners[lit["front"]], corners[lit["back"]][:, ::-1]])
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    usable = lengths > 1e-12
    return LitSides(corners[usable], normals[usable] / lengths[usable, None], lengths[usable] / 2)


def families(sides, min_area):
    """Indices of parallel sides, of both directions, that have that area (m2) together; the
    largest first."""
    left = np.argsort(-sides.areas)
    while len(left) and sides.areas[left].sum() >= min_area:
        parallel = np.abs(sides.normals[left] @ sides.normals[left[0]]) > PARALLEL
        if sides.areas[left[parallel]].sum() >= min_area:
            yield left[parallel]
        left = left[~parallel]


def coplanar_sides(sides, family):
    """Indices of sides in one plane that look the same way; the largest first. The plane is that
    of its largest side: from neighbour to neighbour it would drift."""
    left = family
    while len(left):
        normal, corner = sides.normals[left[0]], sides.corners[left[0], 0]
        distances = np.abs((sides.corners[left] - corner) @ normal).max(axis=1)
        same = (sides.normals[left] @ normal > PARALLEL) & (distances < COPLANAR)
        same[0] = True  # whatever rounding makes of it
        if sides.areas[left[same]].sum() >= SMALLEST_FACE:
            yield left[same]
        left = left[~same]


def faces_of(sides, family):
    """(frame, [Face])"""
    groups = list(coplanar_sides(sides, family))
    normal = sides.normals[family[0]]
    frame = planar.frame_of(sides.corners[groups[0] if groups else family[:1]], normal)
    faces = []
    for group in groups:
        points = frame.to_plane(sides.corners[group])
        outline = planar.outline(points[..., :2])
        if len(outline):
            # The plane through the largest side, as a height over u and v.
            n = frame.axes @ sides.normals[group[0]]
            slope = np.array([n @ points[0, 0], -n[0], -n[1]]) / n[2]
            faces.append(Face(bool(n[2] > 0), slope, outline))
    return frame, faces


def mid_planes(frame_and_faces, thickness) -> list[MidPlane]:
    """What lies in one plane is one of them, though it came from several pairs of faces."""
    frame, faces = frame_and_faces
    pieces = [piece for face in faces if face.looks_up
              for piece in pieces_below(face, faces, thickness)]
    pieces.sort(key=lambda piece: -planar.areas(piece[1]).sum())
    planes = []
    while pieces:
        slope, rest, same = pieces[0][0], [], []
        for piece_slope, triangles in pieces:
            apart = height_on(piece_slope - slope, triangles)
            (same if np.abs(apart).max() < COPLANAR else rest).append((piece_slope, triangles))
        pieces = rest
        triangles = planar.united(np.concatenate([triangles for _, triangles in same]))
        if len(triangles):
            planes.append(MidPlane(frame, slope, triangles))
    return planes


def pieces_below(face, faces, thickness):
    """(slope, (t, 3, 2) triangles) of the planes halfway to the faces that look down and are, in
    that place, the nearest below `face`. All in one arrangement of edges: so a piece spans no hole
    of either face."""
    below = [other for other in faces
             if other is not face and may_lie_below(face, other, thickness)]
    if all(other.looks_up for other in below):
        return
    near = [other.outline[meets_box(other.outline, face.box)] for other in below]
    cells = planar.arrange(np.concatenate([face.outline, *near]))
    centres = cells.mean(axis=1)
    inside = planar.coverage(centres, face.outline) > 0
    cells, centres = cells[inside], centres[inside]
    depths = np.full((len(below), len(cells)), np.inf)
    for depth, other in zip(depths, below):
        distance = face.height(centres) - other.height(centres)
        # What looks up within the tolerance is in the same plane as the face.
        there = distance > (COPLANAR if other.looks_up else -COPLANAR)
        there &= planar.coverage(centres, other.outline) > 0
        depth[there] = distance[there] - (planar.GRID if other.looks_up else 0)  # wins a draw
    if not depths.size:
        return
    nearest, depth = depths.argmin(axis=0), depths.min(axis=0)
    for i, other in enumerate(below):
        chosen = (nearest == i) & (depth <= thickness)
        if not other.looks_up and chosen.any():
            yield (face.slope + other.slope) / 2, cells[chosen]


def may_lie_below(face, other, thickness):
    low, high = np.maximum(face.box[0], other.box[0]), np.minimum(face.box[1], other.box[1])
    if (low >= high).any():
        return False
    corners = np.array([(u, v) for u in (low[0], high[0]) for v in (low[1], high[1])])
    distances = face.height(corners) - other.height(corners)
    return distances.max() >= -COPLANAR and distances.min() <= thickness


def meets_box(edges, box):
    return ((edges.max(axis=1) >= box[0]) & (edges.min(axis=1) <= box[1])).all(axis=1)


def is_substantial(triangles, min_area):
    edges = planar.outline(triangles)
    perimeter = np.linalg.norm(edges[:, 1] - edges[:, 0], axis=1).sum()
    area = planar.areas(triangles).sum()
    return area >= min_area and 0 < NARROWEST * perimeter <= 2 * area


def finish(plane: MidPlane, cells) -> BlockingPlane:
    """As few polygons as there can be without holes. cells: (t, 3, 2) of the plane"""
    corners = plane.to_world(cells)
    weights = planar.areas(corners)
    area = weights.sum()
    centre = (corners.mean(axis=1) * weights[:, None]).sum(axis=0) / area
    # Blender keeps vertices in 32 bits: about the centre they are the more exact.
    vertices, triangles = np.unique((corners - centre).reshape(-1, 3), axis=0, return_inverse=True)
    triangles = triangles.reshape(-1, 3)
    for merge in (True, False):
        mesh = polygons(vertices, triangles, merge)
        # A polygon about a hole would be cut into triangles that cover it.
        if abs(planar.areas(mesh[0][mesh[2]]).sum() - area) < SAME_AREA * area:
            break
    vertices, faces, triangles = mesh
    return BlockingPlane(vertices + centre, faces, triangles, centre, plane.normal, float(area))


def polygons(vertices, triangles, merge):
    """(vertices, polygons, triangles of these), as BlockingPlane has them. merge: without edges
    that are not needed"""
    mesh = bmesh.new()
    try:
        corners = [mesh.verts.new(vertex) for vertex in vertices]
        for triangle in triangles:
            mesh.faces.new([corners[i] for i in triangle])
        mesh.normal_update()
        if merge:
            bmesh.ops.dissolve_limit(mesh, angle_limit=FLAT, use_dissolve_boundaries=False,
                                     verts=mesh.verts[:], edges=mesh.edges[:])
        mesh.verts.index_update()
        return (np.array([vertex.co for vertex in mesh.verts], float),
                [[vertex.index for vertex in face.verts] for face in mesh.faces],
                np.array([[loop.vert.index for loop in loops]
                          for loops in mesh.calc_loop_triangles()], np.int32))
    finally:
        mesh.free()
