# SPDX-License-Identifier: GPL-3.0-or-later
"""What every scene module needs: an empty scene, diffuse materials, meshes from boxes, a camera.

Units are metres and watts, Z is up.  Colours are linear Rec.709.  Everything that differs between
Blender 3.4 and 5.x (socket names, defaults) is dealt with here, so that a scene module reads as a
description of the scene.
"""

import math

import bmesh
import bpy
from mathutils import Matrix, Vector
from mathutils.geometry import delaunay_2d_cdt

# The diffuse lobe of Blender 3.4's Principled BSDF is Disney's, which is Lambertian at no
# roughness.  Its albedo, averaged over cosine-weighted incidence, is .953 of the base colour at
# roughness 0, 1.065 at 1, and .9997 at .425 (numerical integration); from 4.0 on the lobe is
# Lambertian and roughness has no effect on it.  The value that conserves the albedo is used.
LAMBERTIAN_ROUGHNESS = 0.425

FACE_NAMES = ("west", "east", "south", "north", "bottom", "top")  # -X +X -Y +Y -Z +Z


# ---------------------------------------------------------------------------- scene, camera, file


def new_scene(width, height, exposure=0.0):
    """Empties the file and returns its scene with the settings that all scenes share.

    width, height: pixels of the picture.  exposure: stops, the view's and not the renderer's.
    """
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.name = "Scene"
    scene.unit_settings.system = "METRIC"
    scene.render.engine = "CYCLES"  # what a Blender without this add-on falls back to
    scene.render.resolution_x = width
    scene.render.resolution_y = height
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = "Standard"
    scene.view_settings.exposure = exposure
    scene.cycles.use_denoising = False  # Debian's Blender is built without a denoiser
    scene.cycles.samples = 256
    scene.cycles.max_bounces = 64
    scene.cycles.diffuse_bounces = 64
    scene.cycles.sample_clamp_indirect = 0.0
    world = bpy.data.worlds.new("Black")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0.0, 0.0, 0.0, 1.0)
    background.inputs["Strength"].default_value = 0.0
    scene.world = world
    return scene


def add_camera(eye, target, lens, sensor=36.0, shift=(0.0, 0.0)):
    """Makes the scene's camera at `eye` looking at `target`; lens and sensor width in mm."""
    data = bpy.data.cameras.new("Camera")
    data.lens = lens
    data.sensor_width = sensor
    data.shift_x, data.shift_y = shift
    data.clip_start = 0.01
    data.clip_end = 200.0
    camera = bpy.data.objects.new("Camera", data)
    direction = Vector(target) - Vector(eye)
    camera.location = eye
    camera.rotation_euler = direction.to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera
    return camera


def save(path):
    """Writes the scene as a compressed .blend with no data that nothing uses."""
    bpy.ops.outliner.orphans_purge(do_local_ids=True, do_linked_ids=True, do_recursive=True)
    bpy.context.preferences.filepaths.save_version = 0  # no .blend1 beside it
    bpy.ops.wm.save_as_mainfile(filepath=path, compress=True, check_existing=False)


# -------------------------------------------------------------------------------------- materials


def _empty_material(name, colour):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.diffuse_color = (*colour, 1.0)  # the solid view's colour, and the fallback of others
    return material


def _shader_material(name, colour, shader_type):
    """A material with the one shader node `shader_type` on its output, and that node."""
    material = _empty_material(name, colour)
    nodes = material.node_tree.nodes
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    shader = nodes.new(shader_type)
    shader.location.x = output.location.x - 250.0
    material.node_tree.links.new(shader.outputs[0], output.inputs["Surface"])
    return material, shader


def first_input(node, *names):
    """The node's input under the first of `names` that this Blender knows."""
    for name in names:
        if name in node.inputs:
            return node.inputs[name]
    raise KeyError(f"{node.bl_idname} has none of the inputs {names}")


def diffuse(name, colour):
    """A Diffuse BSDF of albedo `colour`."""
    material, shader = _shader_material(name, colour, "ShaderNodeBsdfDiffuse")
    shader.inputs["Color"].default_value = (*colour, 1.0)
    shader.inputs["Roughness"].default_value = 0.0
    return material


def principled(name, colour):
    """A Principled BSDF of base colour `colour` with nothing but its diffuse lobe."""
    material, shader = _shader_material(name, colour, "ShaderNodeBsdfPrincipled")
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    first_input(shader, "Specular IOR Level", "Specular").default_value = 0.0
    shader.inputs["Roughness"].default_value = LAMBERTIAN_ROUGHNESS
    return material


def emissive(name, colour, strength):
    """An Emission shader of radiance colour * strength, W/(m2 sr); it reflects nothing."""
    material, shader = _shader_material(name, colour, "ShaderNodeEmission")
    shader.inputs["Color"].default_value = (*colour, 1.0)
    shader.inputs["Strength"].default_value = strength
    return material


def principled_emissive(name, colour, emission, strength):
    """A Principled BSDF of base colour `colour` that also sends out emission * strength."""
    material = principled(name, colour)
    shader = next(n for n in material.node_tree.nodes if n.bl_idname == "ShaderNodeBsdfPrincipled")
    first_input(shader, "Emission Color", "Emission").default_value = (*emission, 1.0)
    shader.inputs["Emission Strength"].default_value = strength
    return material


def srgb(hexadecimal):
    """The linear Rec.709 colour of an sRGB code such as "d9c7a3" (IEC 61966-2-1)."""

    def linear(code):
        value = code / 255.0
        return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4

    return tuple(linear(int(hexadecimal[i : i + 2], 16)) for i in (0, 2, 4))


# --------------------------------------------------------------------------------------- geometry


class Shape:
    """Polygons with materials, gathered part by part and then made one mesh.

    Parts that stand on or end at one another leave out the faces that would lie between them
    (`skip`): a buried face takes part in light transport without ever being seen.
    """

    def __init__(self):
        self.vertices = []  # (x, y, z), metres
        self.faces = []  # vertex indices, counter-clockwise from the front
        self.face_materials = []  # one a face

    def polygon(self, points, material):
        start = len(self.vertices)
        self.vertices.extend(tuple(point) for point in points)
        self.faces.append(tuple(range(start, start + len(points))))
        self.face_materials.append(material)
        return self

    def box(self, low, high, material, skip=(), inward=False, matrix=None):
        """An axis-aligned box, turned by `matrix` if given; skip: names out of FACE_NAMES."""
        unknown = set(skip) - set(FACE_NAMES)
        if unknown:
            raise ValueError(f"no such faces: {sorted(unknown)}")
        (x0, y0, z0), (x1, y1, z1) = low, high
        quads = {
            "west": ((x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)),
            "east": ((x1, y0, z0), (x1, y1, z0), (x1, y1, z1), (x1, y0, z1)),
            "south": ((x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)),
            "north": ((x0, y1, z0), (x0, y1, z1), (x1, y1, z1), (x1, y1, z0)),
            "bottom": ((x0, y0, z0), (x0, y1, z0), (x1, y1, z0), (x1, y0, z0)),
            "top": ((x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)),
        }
        for face in FACE_NAMES:
            if face in skip:
                continue
            points = [matrix @ Vector(p) if matrix else p for p in quads[face]]
            self.polygon(points[::-1] if inward else points, material)
        return self

    def prism(self, outline, z0, z1, material, bottom=True, top=True):
        """The counter-clockwise polygon `outline` [(x, y)...] pulled up from z0 to z1."""
        n = len(outline)
        for i in range(n):
            (ax, ay), (bx, by) = outline[i], outline[(i + 1) % n]
            self.polygon(((ax, ay, z0), (bx, by, z0), (bx, by, z1), (ax, ay, z1)), material)
        if top:
            self.polygon([(x, y, z1) for x, y in outline], material)
        if bottom:
            self.polygon([(x, y, z0) for x, y in reversed(outline)], material)
        return self

    def cylinder(self, centre, radius, z0, z1, material, segments=8, bottom=True, top=True):
        cx, cy = centre
        angles = [2.0 * math.pi * (i + 0.5) / segments for i in range(segments)]
        outline = [(cx + radius * math.cos(a), cy + radius * math.sin(a)) for a in angles]
        return self.prism(outline, z0, z1, material, bottom, top)

    def lathe(self, centre, profile, material, segments=10):
        """Turns `profile` [(radius, z)...] about the vertical through `centre` (x, y).

        Listed so that the outside lies to the right of the way along it: upwards for an outer wall,
        downwards for the inside of a cup.  A radius of 0 ends in a point.
        """
        cx, cy = centre
        angles = [2.0 * math.pi * i / segments for i in range(segments + 1)]
        directions = [(math.cos(a), math.sin(a)) for a in angles]
        for (r0, z0), (r1, z1) in zip(profile, profile[1:]):
            for (ca, sa), (cb, sb) in zip(directions, directions[1:]):
                points = [
                    (cx + r0 * ca, cy + r0 * sa, z0),
                    (cx + r0 * cb, cy + r0 * sb, z0),
                    (cx + r1 * cb, cy + r1 * sb, z1),
                    (cx + r1 * ca, cy + r1 * sa, z1),
                ]
                if r0 == 0.0:
                    del points[1]
                elif r1 == 0.0:
                    del points[2]
                self.polygon(points, material)
        return self

    def transformed(self, matrix):
        """This shape with every corner moved by `matrix`."""
        self.vertices = [tuple(matrix @ Vector(v)) for v in self.vertices]
        return self

    def add(self, other):
        """Takes in the polygons of another shape."""
        start = len(self.vertices)
        self.vertices.extend(other.vertices)
        self.faces.extend(tuple(start + i for i in face) for face in other.faces)
        self.face_materials.extend(other.face_materials)
        return self

    def sheet(self, axis, position, low, high, material, towards, holes=()):
        """A rectangle across `axis` (0 X, 1 Y, 2 Z) at `position`, its front `towards` +1 or -1.

        low, high: corners in the two other axes, in their order.  holes: (low, high) rectangles
        left out of it (an opening, or the footprint of what stands there); the rest is cut into
        few rectangles that meet the holes edge to edge.
        """
        for (u0, v0), (u1, v1) in rectangles_around(low, high, holes):
            points = []
            for u, v in ((u0, v0), (u1, v0), (u1, v1), (u0, v1)):
                point = [u, v]
                point.insert(axis, position)
                points.append(point)
            # (u, v) are right-handed about +X and +Z, left-handed about +Y.
            faces_up = axis != 1
            self.polygon(points if faces_up == (towards > 0) else points[::-1], material)
        return self

    def mesh(self, name):
        materials = list(dict.fromkeys(self.face_materials))
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata(self.vertices, [], self.faces)
        for material in materials:
            mesh.materials.append(material)
        for polygon, material in zip(mesh.polygons, self.face_materials):
            polygon.material_index = materials.index(material)
        weld(mesh)
        return mesh

    def object(self, name, location=(0.0, 0.0, 0.0), turn=0.0):
        """The object made of this shape; turn: radians about Z."""
        return place(self.mesh(name), name, location, turn)


def place(mesh, name, location=(0.0, 0.0, 0.0), turn=0.0):
    """One more object that shows `mesh`; objects that share a mesh keep the file small."""
    thing = bpy.data.objects.new(name, mesh)
    thing.location = location
    thing.rotation_euler = (0.0, 0.0, turn)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def weld(mesh, distance=1e-5):
    """Joins the corners that parts share, as an artist's mesh would have them."""
    edit = bmesh.new()
    edit.from_mesh(mesh)
    bmesh.ops.remove_doubles(edit, verts=edit.verts, dist=distance)
    edit.to_mesh(mesh)
    edit.free()
    mesh.update()


def rectangles_around(low, high, holes):
    """Cuts the rectangle low..high less the `holes` into few rectangles: [(low, high)...].

    The holes' edges rule a grid over it; runs of free cells are joined, first along u and then,
    where a run of the same width lies on top of the last, along v.
    """
    us = sorted({low[0], high[0], *(h[i][0] for h in holes for i in (0, 1))})
    vs = sorted({low[1], high[1], *(h[i][1] for h in holes for i in (0, 1))})
    us = [u for u in us if low[0] <= u <= high[0]]
    vs = [v for v in vs if low[1] <= v <= high[1]]

    def is_free(u, v):
        return not any(h[0][0] < u < h[1][0] and h[0][1] < v < h[1][1] for h in holes)

    done, growing = [], {}  # growing: (u0, u1) -> v0 of the rectangle that still grows along v
    for v0, v1 in zip(vs, vs[1:]):
        runs = []
        for u0, u1 in zip(us, us[1:]):
            if not is_free((u0 + u1) / 2, (v0 + v1) / 2):
                continue
            if runs and runs[-1][1] == u0:
                runs[-1] = (runs[-1][0], u1)
            else:
                runs.append((u0, u1))
        for run in [r for r in growing if r not in runs]:
            done.append(((run[0], growing.pop(run)), (run[1], v0)))
        for run in runs:
            growing.setdefault(run, v0)
    done.extend(((u0, v0), (u1, vs[-1])) for (u0, u1), v0 in growing.items())
    return done


def triangulated_around(outline, holes, spacing):
    """Cuts the polygon `outline` less the polygons `holes` into triangles that meet the holes.

    All are [(x, y)...], counter-clockwise.  Points are added on a grid of `spacing` metres where
    no edge is near, so that the constrained Delaunay triangulation has no slivers.
    Returns (points, triangles).
    """
    points, edges = [], []
    for loop in (outline, *holes):
        start, n = len(points), len(loop)
        for i in range(n):
            a, b = Vector(loop[i]), Vector(loop[(i + 1) % n])
            steps = max(1, round((b - a).length / spacing))
            points.extend(a.lerp(b, step / steps) for step in range(steps))
        edges.extend((i, i + 1) for i in range(start, len(points) - 1))
        edges.append((len(points) - 1, start))
    border = [(points[a].copy(), points[b].copy()) for a, b in edges]

    xs, ys = [p.x for p in points], [p.y for p in points]
    columns = round((max(xs) - min(xs)) / spacing)
    rows = round((max(ys) - min(ys)) / spacing)
    for i in range(1, columns):
        for j in range(1, rows):
            x = min(xs) + (max(xs) - min(xs)) * i / columns
            y = min(ys) + (max(ys) - min(ys)) * j / rows
            point = Vector((x, y))
            if min(_distance_to_edge(point, a, b) for a, b in border) > 0.45 * spacing:
                points.append(point)
    found, _, triangles, *_ = delaunay_2d_cdt(points, edges, [], 1, 1e-7)
    kept = []
    for triangle in triangles:
        centre = sum((found[i] for i in triangle), Vector((0.0, 0.0))) / 3.0
        if not any(_is_inside(centre, hole) for hole in holes):
            kept.append(tuple(triangle))
    return [(p.x, p.y) for p in found], kept


def _distance_to_edge(point, a, b):
    along = b - a
    t = max(0.0, min(1.0, (point - a).dot(along) / along.length_squared))
    return (point - a - t * along).length


def _is_inside(point, outline):
    """Whether `point` lies left of every edge of the convex counter-clockwise `outline`."""
    n = len(outline)
    for i in range(n):
        a, b = Vector(outline[i]), Vector(outline[(i + 1) % n])
        if (b - a).cross(point - a) < 0.0:
            return False
    return True


# ------------------------------------------------------------------------------------------ lamps


def add_lamp(name, kind, eye, target, colour, energy):
    """A lamp of `kind` POINT, SPOT, SUN or AREA at `eye` shining at `target`; returns its data.

    energy: watts (sun: W/m2).  Not seen by the camera, which is what Blender's Add menu sets too.
    """
    data = bpy.data.lights.new(name, kind)
    data.color = colour
    data.energy = energy
    lamp = bpy.data.objects.new(name, data)
    lamp.location = eye
    direction = Vector(target) - Vector(eye)
    lamp.rotation_euler = direction.to_track_quat("-Z", "Y").to_euler()
    lamp.visible_camera = False
    bpy.context.scene.collection.objects.link(lamp)
    return data


def turn_about(centre, angle):
    """The matrix that turns by `angle` radians about the vertical through `centre` (x, y)."""
    there = Matrix.Translation((centre[0], centre[1], 0.0))
    return there @ Matrix.Rotation(angle, 4, "Z") @ there.inverted()
