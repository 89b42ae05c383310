# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions of a plane, as triangles or as the edges about them. Needs no scene.

A region may overlap itself, and its triangles need not meet vertex to vertex.
"""
from dataclasses import dataclass

import numpy as np
from mathutils import Vector
from mathutils.geometry import delaunay_2d_cdt

GRID = 1e-4  # m: nearer points are one. Blender's coordinates have 24 bits, 1e-6 m at 10 m
WHOLE_HULL = 0  # delaunay_2d_cdt's output_type
PAIRS_AT_ONCE = 1 << 22  # points times edges: for the sake of memory


@dataclass(frozen=True)
class Frame:
    """Coordinates (u, v, height above the plane), m."""
    origin: np.ndarray  # (3,)
    axes: np.ndarray    # (3, 3), its rows are u, v and the plane's normal

    def to_plane(self, points):
        return (points - self.origin) @ self.axes.T

    def to_world(self, points, heights):
        """points: (..., 2), heights: (...)"""
        return self.origin + points @ self.axes[:2] + heights[..., None] * self.axes[2]


def frame_of(triangles, normal) -> Frame:
    """u lies along the longest edge of the region, so that the edges of most walls are rows and
    columns of the grid. triangles: (t, 3, 3), of that normal but for a degree"""
    def frame_along(direction):
        u = direction / np.linalg.norm(direction)
        return Frame(triangles[0, 0], np.array([u, np.cross(normal, u), normal]))

    frame = frame_along(np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))]))
    edges = outline(frame.to_plane(triangles)[..., :2])
    if not len(edges):
        return frame
    along = edges[:, 1] - edges[:, 0]
    return frame_along(along[np.argmax((along ** 2).sum(axis=1))] @ frame.axes[:2])


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def outline(triangles):
    """(e, 2, 2) Directed edges, the region to their left; one that two triangles share is not among
    them, nor is the direction of the triangles of account. triangles: (t, 3, 2)"""
    points = np.rint(triangles / GRID).astype(np.int64)
    area = cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    points[area < 0] = points[area < 0][:, ::-1]
    vertices, corners = np.unique(points[area != 0].reshape(-1, 2), axis=0, return_inverse=True)
    corners = corners.reshape(-1, 3)
    edges = np.stack([corners, np.roll(corners, -1, axis=1)], axis=-1).reshape(-1, 2)
    undirected, index = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True)
    forth = np.where(edges[:, 0] < edges[:, 1], 1, -1)
    net = np.bincount(index.reshape(-1), weights=forth, minlength=len(undirected)).astype(int)
    undirected[net < 0] = undirected[net < 0][:, ::-1]
    return vertices[np.repeat(undirected, np.abs(net), axis=0)] * GRID


def coverage(points, edges):
    """(p,) How many triangles of the region lie over each point, its winding number.
    points: (p, 2), edges: (e, 2, 2) of outline()"""
    count = np.zeros(len(points), int)
    step = max(1, PAIRS_AT_ONCE // max(1, len(edges)))
    begin, end = edges[:, 0], edges[:, 1]
    for first in range(0, len(points), step):
        point = points[first:first + step, None]
        below = begin[:, 1] <= point[..., 1]
        crosses = below != (end[:, 1] <= point[..., 1])
        left = cross(end - begin, point - begin)
        count[first:first + step] = ((crosses & below & (left > 0)).sum(axis=1)
                                     - (crosses & ~below & (left < 0)).sum(axis=1))
    return count


def arrange(edges):
    """(t, 3, 2) Triangles of the edges' convex hull that no edge crosses; they meet vertex to
    vertex. edges: (e, 2, 2)"""
    points, index = np.unique(np.rint(edges.reshape(-1, 2) / GRID), axis=0, return_inverse=True)
    pairs = np.unique(np.sort(index.reshape(-1, 2), axis=1), axis=0)
    pairs = pairs[pairs[:, 0] != pairs[:, 1]]
    if len(points) < 3:
        return np.empty((0, 3, 2))
    vertices, _, faces, *_ = delaunay_2d_cdt(
        [Vector(point) for point in points * GRID], pairs.tolist(), [], WHOLE_HULL, GRID, False)
    if not faces:
        return np.empty((0, 3, 2))
    return np.array(vertices)[np.array(faces)]


def united(triangles):
    """(t, 3, 2) The same region without overlaps, its triangles meet vertex to vertex."""
    edges = outline(triangles)
    cells = arrange(edges)
    return cells[coverage(cells.mean(axis=1), edges) > 0] if len(cells) else cells


def connected(triangles):
    """[(k, 3, 2)]: parts of united() triangles that hang together by their edges."""
    corners = np.unique(triangles.reshape(-1, 2), axis=0, return_inverse=True)[1].reshape(-1, 3)
    edges = np.sort(np.stack([corners, np.roll(corners, -1, axis=1)], axis=-1), axis=-1)
    index = np.unique(edges.reshape(-1, 2), axis=0, return_inverse=True)[1].reshape(-1, 3)
    part = np.arange(len(triangles))
    while True:  # the least number spreads over edges
        of_edge = np.full(index.max() + 1 if index.size else 0, len(triangles))
        np.minimum.at(of_edge, index, part[:, None])
        spread = of_edge[index].min(axis=1)
        spread = spread[spread]  # and in leaps, over triangles that have it already
        if (spread == part).all():
            return [triangles[part == number] for number in np.unique(part)]
        part = spread


def areas(triangles):
    """(t,) m2 of (t, 3, 2 or 3) triangles"""
    first, second = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    if triangles.shape[-1] == 2:
        return np.abs(cross(first, second)) / 2
    return np.linalg.norm(np.cross(first, second), axis=1) / 2
