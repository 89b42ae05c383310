# SPDX-License-Identifier: GPL-3.0-or-later
"""Closes the gaps of mid-planes where walls meet.

A partition interrupts the face of the wall that it meets: as wide as the partition, that wall has
only one face, and no mid-plane. Of two walls that meet in an L, both mid-planes end at the inner
corner. Such gaps lie within matter. Openings, such as doors, do not, and stay: a gap is closed only
if no lit side comes between its edge and what the edge is extended to, and if nearly all that is
seen from within it are unlit sides.
"""
from dataclasses import replace

import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree

from . import planar

# m: a mid-plane is cut so far above and below it, since openings often have edges right in it.
OFF_PLANE = 0.001
CLEARANCE = 0.005  # m, by which lit sides must be farther than what is extended to
PARALLEL = 0.95    # of planes that do not cut one another: cosine of their angle
SAMPLE_SPACING = 0.25  # m, between points at which a gap is tested for being matter
TWO_TRIANGLES = [[0, 1, 2], [0, 2, 3]]  # of a quad
VIEWS = 24
# Of the sides seen from within matter: a floor that goes on below a wall counts as lit there too,
# and fills half of the view. In an opening nearly all are lit.
MOST_LIT = 0.6


def close_junctions(planes, lit, thickness):
    """The planes (wall_planes.MidPlane), extended through matter by up to `thickness` (m) to
    themselves and to one another."""
    surroundings = Surroundings(lit)
    extents = np.array([extent(plane, thickness) for plane in planes]).reshape(-1, 2, 3, 3)
    normals = np.array([plane.normal for plane in planes]).reshape(-1, 3)
    closed = []
    for plane, normal in zip(planes, normals):
        others = extents[np.abs(normals @ normal) < PARALLEL].reshape(-1, 3, 3)
        gaps = surroundings.gaps(plane, cut_triangles(*above(plane, others)), thickness)
        closed.append(replace(plane, triangles=planar.united(
            np.concatenate([plane.triangles, *gaps]))) if gaps else plane)
    return closed


def extent(plane, margin):
    """(2, 3, 3) Triangles of the rectangle about the plane, with a margin, in world space."""
    low = plane.triangles.min(axis=(0, 1)) - margin
    high = plane.triangles.max(axis=(0, 1)) + margin
    corners = plane.to_world(np.array([low, (high[0], low[1]), high, (low[0], high[1])]))
    return corners[TWO_TRIANGLES]


def above(plane, points):
    """(..., 2) position and (...) height above the plane, of world-space points (..., 3)"""
    local = plane.frame.to_plane(points)
    return local[..., :2], local[..., 2] - plane.height(local[..., :2])


def cut_triangles(points, heights):
    """(s, 2, 2) Segments at height 0 of triangles. points: (t, 3, 2), heights: (t, 3)"""
    low = heights < 0
    crossing = low.any(axis=1) & ~low.all(axis=1)
    points, heights, low = points[crossing], heights[crossing], low[crossing]
    following = np.roll(points, -1, axis=1), np.roll(heights, -1, axis=1)
    cuts = low != np.roll(low, -1, axis=1)  # two edges of each triangle
    share = heights[cuts] / (heights[cuts] - following[1][cuts])
    ends = points[cuts] + (following[0][cuts] - points[cuts]) * share[:, None]
    return ends.reshape(-1, 2, 2)


class Surroundings:
    """All triangles of the scene and which of their sides are lit."""

    def __init__(self, lit):
        corners = lit["corners"].astype(float)
        self._lit = np.array([lit["front"], lit["back"]])  # (2, #triangles)
        self._lit_corners = corners[self._lit.any(axis=0)]
        self._tree = BVHTree.FromPolygons(
            corners.reshape(-1, 3).tolist(), np.arange(3 * len(corners)).reshape(-1, 3).tolist(),
            all_triangles=True)
        self._directions = [Vector(direction) for direction in sphere(VIEWS)]

    def gaps(self, plane, lines, reach):
        """[(2, 3, 2) triangles] lines: (l, 2, 2) where other planes are, in this one"""
        outline = planar.outline(plane.triangles)
        points, heights = above(plane, self._lit_corners)
        lit = np.concatenate([cut_triangles(points, heights - OFF_PLANE),
                              cut_triangles(points, heights + OFF_PLANE)])
        found = []
        for edge in outline:
            for quad in extensions(edge, outline, lines, lit, reach):
                if self._is_matter(plane.to_world(sample(quad))):
                    found.append(quad[TWO_TRIANGLES])
        return found

    def _is_matter(self, points):
        return all(self._lit_share(Vector(point)) <= MOST_LIT for point in points)

    def _lit_share(self, point):
        """Of the sides that are seen from a point; 1 if there are none, as in the open."""
        seen = lit = 0
        for direction in self._directions:
            _, normal, triangle, _ = self._tree.ray_cast(point, direction)
            if triangle is not None:
                seen += 1
                lit += self._lit[int(normal.dot(direction) > 0), triangle]
        return lit / seen if seen else 1.0


def extensions(edge, outline, lines, lit, reach):
    """[(4, 2)] Quads between an edge of the outline and what lies beside it, outwards: edges of the
    outline that face it, or lines, if within reach and before the lit segments."""
    frame = EdgeFrame(edge)
    facing, lines, lit = (frame.beside(segments, reach) for segments in (outline, lines, lit))
    targets = np.concatenate([facing[facing[:, 1, 0] < facing[:, 0, 0]], lines])
    if not len(targets):
        return []
    targets, lit = sorted_along(targets), sorted_along(lit)
    stops = np.unique(np.clip(np.concatenate([
        targets[..., 0].ravel(), lit[..., 0].ravel(), [0, frame.length]]), 0, frame.length))
    quads = []
    for low, high in zip(stops, stops[1:]):
        if high - low < 3 * planar.GRID:
            continue
        target = distances(targets, low, high)
        target = target[(target.min(axis=1) > planar.GRID) & (target.max(axis=1) <= reach)]
        if not len(target):
            continue
        nearest = target[target.max(axis=1).argmin()]
        barriers = distances(lit, low, high)
        barriers = barriers[barriers.max(axis=1) > -CLEARANCE]
        if (barriers.min(axis=1) > nearest.max() + CLEARANCE).all():
            quads.append(frame.points([[low, 0], [high, 0], [high, nearest[1]], [low, nearest[0]]]))
    return quads


class EdgeFrame:
    """Coordinates along a directed edge and outwards, to its right."""

    def __init__(self, edge):
        self._begin = edge[0]
        along = edge[1] - edge[0]
        self.length = np.linalg.norm(along)
        along = along / self.length
        self._axes = np.array([along, (along[1], -along[0])])

    def beside(self, segments, reach):
        """Those of the segments, in these coordinates, that may lie beside the edge."""
        local = (segments - self._begin) @ self._axes.T
        low, high = local.min(axis=1), local.max(axis=1)
        return local[(high[:, 0] > planar.GRID) & (low[:, 0] < self.length - planar.GRID)
                     & (high[:, 1] > -CLEARANCE) & (low[:, 1] < reach + CLEARANCE)]

    def points(self, local):
        return self._begin + np.array(local) @ self._axes


def sorted_along(segments):
    return np.take_along_axis(segments, segments[..., :1].argsort(axis=1), axis=1)


def distances(segments, low, high):
    """(k, 2) At both ends of a stretch, of the segments that go along all of it."""
    begin, end = segments[:, 0], segments[:, 1]
    spanning = (begin[:, 0] < low + planar.GRID) & (end[:, 0] > high - planar.GRID)
    begin, end = begin[spanning], end[spanning]
    slope = (end[:, 1] - begin[:, 1]) / (end[:, 0] - begin[:, 0])
    return begin[:, 1:] + slope[:, None] * (np.array([low, high]) - begin[:, :1])


def sample(quad):
    """(p, 2) Points all over a quad."""
    sides = np.linalg.norm(quad[1] - quad[0]), np.linalg.norm(quad[3] - quad[0])
    a, b = (np.linspace(0.1, 0.9, 2 + int(side / SAMPLE_SPACING)) for side in sides)
    a, b = (shares.reshape(-1, 1) for shares in np.meshgrid(a, b))
    return ((1 - a) * ((1 - b) * quad[0] + b * quad[3]) + a * ((1 - b) * quad[1] + b * quad[2]))


def sphere(count):
    """(count, 3) Directions all around: a Fibonacci lattice, askew to walls."""
    number = np.arange(count)
    z = 1 - (2 * number + 1) / count
    azimuth = number * np.pi * (3 - np.sqrt(5)) + 0.5
    radius = np.sqrt(1 - z * z)
    return np.stack([radius * np.cos(azimuth), radius * np.sin(azimuth), z], axis=1)
