# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators, properties and panels of blocking planes.

argument: a folder for a library. Result: {CASE: what it returns}
"""

import math
import pathlib
import sys
import types

import addon_utils
import bmesh
import bpy
import numpy as np
from mathutils import Euler, Matrix

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402
from recorder import blocker, cube, empty_scene, link, material, quad  # noqa: E402

FOLDER = pathlib.Path(recorder.arguments()[0])
blockers, render_log = recorder.addon("blockers"), recorder.addon("render_log")
RAY_VISIBILITY = ("visible_camera", "visible_diffuse", "visible_glossy", "visible_transmission",
                  "visible_volume_scatter", "visible_shadow")
operators = bpy.ops.antiradiance


def state_of(thing):
    return {"blocker": thing.antiradiance.is_blocker, "display": thing.display_type,
            "rays": [getattr(thing, name) for name in RAY_VISIBILITY]}


def world_corners(thing):
    bpy.context.view_layer.update()
    return [thing.matrix_world @ vertex.co for vertex in thing.data.vertices]


def select(*things):
    bpy.context.view_layer.update()  # what is not yet evaluated counts as hidden
    for thing in bpy.context.view_layer.objects:
        thing.select_set(thing in things)
    bpy.context.view_layer.objects.active = things[0] if things else None


def failure_of(operator, *arguments, **properties):
    """The error that an operator ends with, "" if it does not."""
    try:
        operator(*arguments, **properties)
    except RuntimeError as error:
        return str(error)
    return ""


def added():
    scene = empty_scene()
    scene.cursor.location, scene.cursor.rotation_euler = (1, 2, 3), (math.pi / 2, 0, 0)
    other = cube()
    select(other)
    results = {}
    for align in ("WORLD", "CURSOR", "VIEW"):
        bpy.context.preferences.edit.object_align = align
        operators.add_blocking_plane(size=4.0)
        plane = bpy.context.object
        results[align] = {
            **state_of(plane), "corners": world_corners(plane), "polygons": len(plane.data.polygons),
            "selected": [thing.name for thing in bpy.context.selected_objects], "name": plane.name}
    bpy.context.preferences.edit.object_align = "WORLD"
    return results


def in_edit_mode():
    empty_scene()
    select(cube())
    bpy.ops.object.mode_set(mode="EDIT")
    failures = [failure_of(operators.add_blocking_plane), failure_of(operators.evaluate_blocking_planes)]
    bpy.ops.object.mode_set(mode="OBJECT")
    return failures


def marked():
    empty_scene()
    mesh, lamp = quad("Wall"), link(bpy.data.lights.new("Lamp", "POINT"), "Lamp")
    nothing = failure_of(operators.make_blocker)
    select(lamp)
    only_lamp = operators.make_blocker()
    select(mesh, lamp)
    both = operators.make_blocker()
    made = state_of(mesh)
    operators.clear_blocker()
    return {"nothing": nothing, "only_lamp": only_lamp, "both": both, "made": made,
            "cleared": state_of(mesh)}


def problems():
    empty_scene()
    library = str(FOLDER / "plane.blend")
    bpy.data.libraries.write(library, {quad("Linked")})
    empty_scene()
    with bpy.data.libraries.load(library, link=True) as (_there, wanted):
        wanted.objects = ["Linked"]
    linked, lamp = wanted.objects[0], link(bpy.data.lights.new("Lamp", "POINT"), "Lamp")
    return {"said": recorder.addon("blocker_operators").mark([linked, lamp, quad("Own")], True),
            "marked": [thing.name for thing in (linked, bpy.data.objects["Own"])
                       if thing.antiradiance.is_blocker]}


def undone():
    empty_scene()
    wall = quad("Wall")
    select(wall)
    bpy.ops.ed.undo_push(message="before")
    operators.make_blocker("EXEC_DEFAULT", True)
    operators.add_blocking_plane("EXEC_DEFAULT", True)
    states = [there()]
    for step in (bpy.ops.ed.undo, bpy.ops.ed.undo, bpy.ops.ed.redo, bpy.ops.ed.redo):
        step()
        states.append(there())
    return states


def there():
    """Names of the scene's blocking planes."""
    return sorted(thing.name for thing in blockers.of_scene(bpy.context.scene))


def box(name, low, high, **attributes):
    thing = cube(name, size=1.0, **attributes)
    low, high = np.array(low, float), np.array(high, float)
    for vertex in thing.data.vertices:
        vertex.co = low + (np.array(vertex.co) + 0.5) * (high - low)
    bpy.context.view_layer.update()
    return thing


# Of cube(): the face at high Y looks along +Y.
FRONT = 3


def from_face(wall, face, **properties):
    """What the operator makes; corners in the wall's own space."""
    wall.data.polygons.active = face
    select(wall)
    before = set(bpy.data.objects)
    error = failure_of(operators.blocking_plane_from_face, **properties)
    new = set(bpy.data.objects) - before
    if not new:
        return {"error": error}
    (plane,) = new
    bpy.context.view_layer.update()
    to_wall = wall.matrix_world.inverted()
    corners = np.array([to_wall @ corner for corner in world_corners(plane)])
    return {
        **state_of(plane), "error": error, "corners": corners, "faces": len(plane.data.polygons),
        "low": corners.min(axis=0), "high": corners.max(axis=0), "active": bpy.context.object.name,
        "flat": max(abs(vertex.co.z) for vertex in plane.data.vertices),
        "centre": np.array(to_wall @ plane.matrix_world.translation), "name": plane.name,
        "scale": list(plane.scale)}


def wall_moved_anyhow():
    """A wall 4 x 0.3 x 2.5 by its scale, turned; and the same mirrored."""
    results = []
    for mirror in (1, -1):
        empty_scene()
        matrix = (Matrix.Translation((5, -3, 1)) @ Euler((0.3, -0.5, 1.1)).to_matrix().to_4x4()
                  @ Matrix.Diagonal((4 * mirror, 0.3, 2.5, 1)))
        results.append(from_face(box("Wall", (-1, -1, -1), (1, 1, 1), matrix_world=matrix), FRONT,
                                 thickness=0.7))
    return results


def thin_limit():
    """The other side is farther than the limit; then a scaled object, its limit in metres."""
    empty_scene()
    far = from_face(box("Wall", (0, 0, 0), (4, 0.6, 3)), FRONT, thickness=0.5)
    empty_scene()
    scaled = box("Wall", (0, 0, 0), (4, 0.6, 3))
    scaled.scale.y = 0.5
    bpy.context.view_layer.update()
    return {"far": far, "scaled": from_face(scaled, FRONT, thickness=0.5)}


def triangulated_with_window():
    """All of the wall's front, which has an opening, in triangles."""
    empty_scene()
    wall = box("Wall", (0, 0, 0), (4, 0.2, 3))
    bm = bmesh.new()
    bm.from_mesh(wall.data)
    front = [face for face in bm.faces if face.normal.y > 0.9]
    bmesh.ops.inset_region(bm, faces=front, thickness=1.0)
    bmesh.ops.delete(bm, geom=front, context="FACES")
    bmesh.ops.triangulate(bm, faces=bm.faces)
    bm.to_mesh(wall.data)
    bm.free()
    bpy.context.view_layer.update()
    front = [polygon for polygon in wall.data.polygons if polygon.normal.y > 0.9]
    front_area = sum(polygon.area for polygon in front)
    result = from_face(wall, front[0].index)
    plane = bpy.data.objects[result["name"]]
    return {**result, "front_area": front_area,
            "area": sum(polygon.area for polygon in plane.data.polygons)}


def triangulated_quad():
    empty_scene()
    wall = box("Wall", (0, 0, 0), (4, 0.2, 3))
    bm = bmesh.new()
    bm.from_mesh(wall.data)
    bmesh.ops.triangulate(bm, faces=bm.faces)
    bm.to_mesh(wall.data)
    bm.free()
    return from_face(wall, next(p.index for p in wall.data.polygons if p.normal.y > 0.9))


def two_shells():
    """Walls as single planes of two objects; asked twice, as the first answer is in between."""
    empty_scene()
    first = quad("First", rotation_euler=(-math.pi / 2, 0, 0))
    quad("Second", rotation_euler=(math.pi / 2, 0, 0), location=(0, -0.4, 0))
    bpy.context.view_layer.update()
    return [from_face(first, 0), from_face(first, 0)]


def concave_face():
    """A U, whose centre is outside of it."""
    empty_scene()
    outline = [(0, 0), (3, 0), (3, 3), (2.8, 3), (2.8, 0.2), (0.2, 0.2), (0.2, 3), (0, 3)]
    bm = bmesh.new()
    face = bm.faces.new([bm.verts.new((x, 0, z)) for x, z in reversed(outline)])
    bm.normal_update()
    bmesh.ops.solidify(bm, geom=[face], thickness=0.2)
    bmesh.ops.recalc_face_normals(bm, faces=bm.faces)
    mesh = bpy.data.meshes.new("U")
    bm.to_mesh(mesh)
    bm.free()
    wall = link(mesh, "U")
    bpy.context.view_layer.update()
    front = max(mesh.polygons, key=lambda p: p.normal.y).index
    return {**from_face(wall, front), "low_y": min(v.co.y for v in mesh.vertices),
            "high_y": max(v.co.y for v in mesh.vertices)}


def face_in_edit_mode():
    empty_scene()
    wall = box("Wall", (0, 0, 0), (4, 0.2, 3))
    select(wall)
    bpy.ops.object.mode_set(mode="EDIT")
    bm = bmesh.from_edit_mesh(wall.data)
    bm.faces.ensure_lookup_table()
    bm.faces.active = bm.faces[FRONT]
    for vertex in bm.verts:
        vertex.co.x += 1.0  # not in the mesh yet
    operators.blocking_plane_from_face()
    plane = bpy.context.object
    return {"mode": bpy.context.mode, "name": plane.name, "corners": world_corners(plane)}


def no_face():
    empty_scene()
    wall = cube("Wall")
    none = from_face(wall, -1)
    flat = bpy.data.meshes.new("Flat")
    flat.from_pydata([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [], [(0, 1, 2)])
    degenerate = from_face(link(flat, "Flat"), 0)
    vertices = bpy.data.meshes.new("Vertices")
    vertices.from_pydata([(0, 0, 0)], [], [])
    empty = from_face(link(vertices, "Vertices"), 0)
    select(bpy.context.scene.camera)
    return {"none": none, "degenerate": degenerate, "empty": empty,
            "no_mesh": failure_of(operators.blocking_plane_from_face)}


def rows():
    """A row of the list is the active object."""
    scene = empty_scene()
    first, second = blocker("First"), blocker("Second")
    view = scene.antiradiance_blockers
    select()
    indices = [view.active_index]
    for thing in (first, second):
        view.active_index = scene.objects.find(thing.name)
        indices.append(bpy.context.object.name)
        indices.append([thing.name for thing in bpy.context.selected_objects])
    bpy.ops.object.mode_set(mode="EDIT")
    view.active_index = scene.objects.find("First")
    indices.append(bpy.context.object.name)
    bpy.ops.object.mode_set(mode="OBJECT")
    aside = bpy.data.collections.new("Aside")
    scene.collection.children.link(aside)
    aside.objects.link(first)
    scene.collection.objects.unlink(first)
    bpy.context.view_layer.layer_collection.children["Aside"].exclude = True
    view.active_index = scene.objects.find("First")
    indices.append(bpy.context.object.name)
    return {"rows": indices, "listed": there()}


class Row:
    """Takes what a list's row, or a menu, draws."""

    alignment = alert = active = None

    def __init__(self, shown):
        self._shown = shown

    def row(self, **_arguments):
        return Row(self._shown)

    split = row

    def label(self, text):
        self._shown.append((text, bool(self.alert)))

    def separator(self):
        pass

    def operator(self, name, **_arguments):
        self._shown.append(name)

    def prop(self, _owner, name, icon, **_arguments):
        self._shown.append((name, self.active, icon))


def shown_figures():
    """The list's rows: not rendered; rendered; evaluated."""
    scene = empty_scene()
    for name, mute in (("Good", False), ("Bad", False), ("Muted", True)):
        blocker(name, mute=mute)
    panel, results = recorder.addon("blocker_panel"), []

    def note():
        for thing in blockers.of_scene(scene):
            shown = []
            panel.ANTIRADIANCE_UL_blockers.draw_item(
                None, bpy.context, Row(shown), scene, thing, 0, None, "")
            results.append([thing.name, *shown])

    note()
    planes = [{"name": "Good", "links_cut": 1234}, {"name": "Bad", "links_cut": 56789},
              {"name": "Bad (instanced by Row)", "links_cut": 1}, {"name": "Badly", "links_cut": 9}]
    render_log.remember(scene.name, render_log.Outcome(report={"blockers": {"per_plane": planes}}))
    note()
    judged = [{**plane, "radiance_cut": 299, "occluded_cut": 999,
               "wrongly_cut": 3 if "Bad" in plane["name"] else 2} for plane in planes]
    render_log.remember_evaluation(scene.name, {"per_plane": judged})
    note()
    render_log.clear()
    return results


def filtered():
    """What the list lets through: by default, by name, inverted."""
    scene = empty_scene()
    blocker("Wall north"), blocker("Wall south"), blocker("Door"), cube("Wall itself")
    panel, results = recorder.addon("blocker_panel"), []
    for name, invert in (("", False), ("Wall", False), ("Wall", True)):
        state = type("State", (), {"filter_name": name, "use_filter_invert": invert,
                                   "bitflag_filter_item": 1 << 30, "use_filter_sort_alpha": False})
        flags, _order = panel.ANTIRADIANCE_UL_blockers.filter_items(state, bpy.context, scene, "objects")
        results.append([thing.name for thing, flag in zip(scene.objects, flags)
                        if bool(flag) != invert])
    return results


def menus():
    """The entries, with this engine and with another."""
    scene, entries = empty_scene(), {}
    for engine in ("ANTIRADIANCE", "BLENDER_WORKBENCH"):
        scene.render.engine = engine
        shown = entries.setdefault(engine, {})
        for name, draw in recorder.addon("blocker_panel").MENUS:
            drawn = shown.setdefault(name, [])
            draw(types.SimpleNamespace(layout=Row(drawn)), bpy.context)
    return entries


def evaluated():
    """A wall between two halves of a room, with a plane in it, one in the open and a muted one."""
    scene = empty_scene()
    scene.render.engine = "ANTIRADIANCE"
    scene.render.resolution_x, scene.render.resolution_y = 8, 6
    scene.antiradiance.visibility, scene.antiradiance.max_patch_size = "IMPLICIT", 1.0
    surfaces = (quad("Floor", scale=(4, 4, 1)),
                quad("Ceiling", scale=(4, 4, 1), location=(0, 0, 3), rotation_euler=(math.pi, 0, 0)),
                cube("Wall", location=(0, 0, 1.5), scale=(0.1, 5, 2)))
    for surface in surfaces:
        surface.data.materials.append(material(surface.name, albedo=(0.6,) * 3))
    for x in (-2, 2):
        lamp = bpy.data.lights.new("Lamp", "POINT")
        lamp.energy = 100.0
        link(lamp, "Lamp", location=(x, 0, 2))
    upright = {"rotation_euler": (0, math.pi / 2, 0), "scale": (1.6, 4.5, 1)}
    blocker("Inside", location=(0, 0, 1.5), **upright)
    blocker("Open", location=(2, 0, 1.5), **upright)
    blocker("Muted", location=(3, 0, 1.5), mute=True, **upright)
    evaluation_of, texts = recorder.addon("blocker_evaluation"), []

    def evaluate():
        operators.evaluate_blocking_planes()
        evaluation = render_log.last_evaluation(scene.name)
        texts.append((evaluation_of.totals(evaluation), evaluation_of.verdict(evaluation)))
        return evaluation

    result = {"evaluation": evaluate(), "texts": texts}
    bpy.ops.render.render()
    result["rendered"] = render_log.last(scene.name).report["blockers"]
    bpy.data.objects["Open"].antiradiance.mute = True
    evaluate()
    bpy.data.objects["Inside"].location.x = 50.0
    evaluate()
    for surface in surfaces:
        bpy.data.objects.remove(surface)
    result["error"] = failure_of(operators.evaluate_blocking_planes)
    render_log.clear()
    return result


def add_on_off():
    """What is left in Blender when the add-on is disabled, and when its native module is missing."""
    empty_scene()
    quad("Wall").antiradiance.is_blocker = True
    core, registry = recorder.addon("core"), recorder.addon("registry")
    package = core.__package__

    def left():
        entries = [entry for name in ("VIEW3D_MT_mesh_add", "VIEW3D_MT_object",
                                      "VIEW3D_MT_edit_mesh_faces")
                   for entry in getattr(bpy.types, name)._dyn_ui_initialize()
                   if entry.__module__.startswith(package)]
        return {"menus": len(entries), "object": hasattr(bpy.types.Object, "antiradiance"),
                "panel": hasattr(bpy.types, "RENDER_PT_antiradiance_blockers")}

    states = {"on": left()}
    addon_utils.disable(package)
    states["off"] = left()
    native, core.native = core.native, None
    registry.register()
    states["without_core"] = left()
    registry.unregister()
    states["off_again"] = left()
    core.native = native
    addon_utils.enable(package)
    states["on_again"] = left()
    return {**states, "kept": bpy.data.objects["Wall"].antiradiance.is_blocker}


CASES = (added, in_edit_mode, marked, problems, undone, wall_moved_anyhow,
         thin_limit, triangulated_with_window, triangulated_quad, two_shells, concave_face,
         face_in_edit_mode, no_face, rows, shown_figures, filtered, menus, evaluated,
         add_on_off)
recorder.finish({case.__name__: case() for case in CASES})
