# SPDX-License-Identifier: GPL-3.0-or-later
"""A face of a wall -> the plane in the wall's middle. All lengths in the world's metres, so that
objects may be scaled, sheared or mirrored."""
from dataclasses import dataclass

import bmesh
import bpy
import numpy as np
from mathutils import Matrix, Vector
from mathutils.bvhtree import BVHTree

from .blockers import is_blocker

# Faces continue each other if the cosine between their normals is above this: 0.08 degrees.
COPLANAR = 1 - 1e-6
# A ray starts this share of its length below the face, so as not to find that.
RAY_OFFSET = 1e-3


class NoFaceError(Exception):
    """What the artist has to do before there is a face to start from."""


@dataclass(frozen=True)
class Face:
    index: int      # of the polygon
    point: Vector   # well inside of it, world space
    normal: Vector  # unit length, world space


def active_face(wall) -> Face:
    mesh = wall.data
    index = mesh.polygons.active
    if not 0 <= index < len(mesh.polygons):
        raise NoFaceError(f"Object '{wall.name}': it has no active face. Click one in Edit Mode, "
                          "with face selection")
    matrix, polygon = wall.matrix_world, mesh.polygons[index]
    # The inverse transpose keeps normals outward, also under a mirroring matrix.
    normal = (matrix.to_3x3().inverted_safe().transposed() @ polygon.normal).normalized()
    if not normal.length or not polygon.area:
        raise NoFaceError(f"Object '{wall.name}': its active face has no area, choose another")
    # The centre of a concave face can lie outside of it; that of a triangle does not.
    mesh.calc_loop_triangles()
    triangle = max((t for t in mesh.loop_triangles if t.polygon_index == index),
                   key=lambda t: t.area)
    corners = [mesh.vertices[vertex].co for vertex in triangle.vertices]
    return Face(index, matrix @ (sum(corners, Vector()) / 3), normal)


def depth(wall, face: Face, limit: float, depsgraph) -> float | None:
    """m, from the face to the wall's other side, of the object itself or, where its walls are
    shells, of another; None if there is none within `limit`."""
    direction, offset = -face.normal, RAY_OFFSET * limit
    start = face.point + offset * direction
    hit = BVHTree.FromPolygons(
        [wall.matrix_world @ vertex.co for vertex in wall.data.vertices],
        [polygon.vertices for polygon in wall.data.polygons],
    ).ray_cast(start, direction, limit - offset)[0]
    while hit is None:
        left = limit - (start - face.point).length
        found, hit, _normal, _index, thing, _matrix = depsgraph.scene.ray_cast(
            depsgraph, start, direction, distance=max(left, 0.0))
        if not found:
            return None
        if is_blocker(thing):  # an earlier one in the same wall
            start, hit = hit + offset * direction, None
    return (hit - face.point).length


def coplanar_region(face) -> list:
    """The faces in one plane with `face` (a bmesh's) that edges connect with it, itself first."""
    region, seen = [face], {face}
    for member in region:  # which grows meanwhile
        for edge in member.edges:
            for other in edge.link_faces:
                if other not in seen and other.normal.dot(face.normal) > COPLANAR:
                    seen.add(other)
                    region.append(other)
    return region


def make_plane(name: str, wall, face: Face, depth: float) -> tuple[bpy.types.Mesh, Matrix]:
    """(mesh, object's matrix) of the face's plane at half the depth below it. The object's origin
    is the outline's centre, its Z axis the face's normal."""
    rotation = face.normal.to_track_quat("Z", "Y").to_matrix()
    origin = face.point - 0.5 * depth * face.normal
    source, outline = bmesh.new(), bmesh.new()
    try:
        source.from_mesh(wall.data)
        source.faces.ensure_lookup_table()
        region = coplanar_region(source.faces[face.index])
        copies = {vertex: outline.verts.new(vertex.co)
                  for vertex in dict.fromkeys(v for member in region for v in member.verts)}
        for member in region:
            outline.faces.new([copies[vertex] for vertex in member.verts])
        outline.transform(rotation.transposed().to_4x4() @ Matrix.Translation(-face.point)
                          @ wall.matrix_world)
        outline.normal_update()
        # One polygon where there is no hole.
        bmesh.ops.dissolve_limit(outline, angle_limit=0.01, verts=outline.verts,
                                 edges=outline.edges)
        corners = np.array([vertex.co for vertex in outline.verts])
        centre = Vector((corners.min(axis=0) + corners.max(axis=0)) / 2)
        bmesh.ops.translate(outline, vec=-centre, verts=outline.verts)
        mesh = bpy.data.meshes.new(name)
        outline.to_mesh(mesh)
    finally:
        source.free()
        outline.free()
    return mesh, Matrix.Translation(origin + rotation @ centre) @ rotation.to_4x4()
