# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds one small scene per case and tells what sync makes of it.

argument: a folder for a library.
"""

import math
import pathlib
import sys

import bpy
import numpy as np
from mathutils import Matrix

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402
from recorder import blocker, cube, link, quad  # noqa: E402

FOLDER = pathlib.Path(recorder.arguments()[0])
CASES = {}


def case(build):
    CASES[build.__name__] = build
    return build


@case
def plain_cube():
    cube(location=(3.0, 0.0, 0.0))


@case
def n_gon():
    mesh = bpy.data.meshes.new("Pentagon")
    points = [(math.cos(2 * math.pi * i / 5), math.sin(2 * math.pi * i / 5), 0) for i in range(5)]
    mesh.from_pydata(points, [], [tuple(range(5))])
    link(mesh, "Pentagon")


@case
def negative_scale():
    cube(location=(5.0, 1.0, 0.0), scale=(-1.0, 2.0, 1.0))


@case
def sheared_by_parents():
    parent = link(None, "Parent", scale=(1.0, 3.0, 1.0), rotation_euler=(0.0, 0.0, math.pi / 4))
    child = cube("Child", rotation_euler=(0.0, 0.0, math.pi / 4))
    child.parent = parent


@case
def modifiers():
    cube("Subdivided").modifiers.new("Subdivision", "SUBSURF").render_levels = 2
    array = cube("Row").modifiers.new("Array", "ARRAY")
    array.count = 3
    array.relative_offset_displace = (1.5, 0.0, 0.0)
    viewport_only = cube("Off").modifiers.new("Array", "ARRAY")
    viewport_only.show_render = False


@case
def text_curve_metaball():
    text = bpy.data.curves.new("Text", "FONT")
    text.body = "A"
    text.extrude = 0.1
    link(text, "Text")
    path = bpy.data.curves.new("Pipe", "CURVE")
    path.dimensions = "3D"
    spline = path.splines.new("POLY")
    spline.points.add(1)
    spline.points[0].co = (0.0, 0.0, 0.0, 1.0)
    spline.points[1].co = (0.0, 0.0, 2.0, 1.0)
    path.bevel_depth = 0.25
    link(path, "Pipe")
    surface = bpy.data.curves.new("Bare", "CURVE")  # a path without thickness has no surface
    surface.splines.new("POLY").points.add(2)
    link(surface, "Bare")
    for name, x in (("Ball", 0.0), ("Ball.001", 1.0)):
        ball = bpy.data.metaballs.new(name)
        ball.elements.new()
        ball.resolution = ball.render_resolution  # so that the expected mesh is the rendered one
        link(ball, name, location=(x, 0.0, 0.0))


@case
def collection_instances():
    chairs = bpy.data.collections.new("Chairs")  # not in the scene but by its instances
    chair = bpy.data.objects.new("Chair", cube("Seat", size=1.0).data)
    bpy.data.objects.remove(bpy.data.objects["Seat"])
    chair.location = (0.0, 0.0, 0.5)
    chairs.objects.link(chair)
    for name, x in (("Row A", 10.0), ("Row B", 20.0)):
        empty = link(None, name, location=(x, 0.0, 0.0))
        empty.instance_type = "COLLECTION"
        empty.instance_collection = chairs


@case
def linked_duplicates():
    first = cube("First")
    link(first.data, "Second", location=(4.0, 0.0, 0.0))


@case
def vertex_instances():
    square = quad("Carrier")
    small = cube("Small", size=0.2)
    small.parent = square
    square.instance_type = "VERTS"
    square.show_instancer_for_render = False


@case
def particle_instances():
    nail = cube("Nail", size=0.1, location=(0.0, 0.0, 50.0))
    board = quad("Board")
    board.modifiers.new("Nails", "PARTICLE_SYSTEM")
    settings = board.particle_systems[0].settings
    settings.type = "HAIR"
    settings.count = 7
    settings.render_type = "OBJECT"
    settings.instance_object = nail
    fur = quad("Fur")
    fur.modifiers.new("Hair", "PARTICLE_SYSTEM")
    fur.particle_systems[0].settings.type = "HAIR"


@case
def geometry_nodes():
    tree = bpy.data.node_groups.new("Scatter", "GeometryNodeTree")
    if hasattr(tree, "interface"):
        tree.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
        tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    else:
        tree.inputs.new("NodeSocketGeometry", "Geometry")
        tree.outputs.new("NodeSocketGeometry", "Geometry")
    inlet, outlet = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    scatter = tree.nodes.new("GeometryNodeInstanceOnPoints")
    block = tree.nodes.new("GeometryNodeMeshCube")
    block.inputs["Size"].default_value = (0.2, 0.2, 0.2)
    tree.links.new(inlet.outputs[0], scatter.inputs["Points"])
    tree.links.new(block.outputs["Mesh"], scatter.inputs["Instance"])
    tree.links.new(scatter.outputs["Instances"], outlet.inputs[0])
    quad("Points").modifiers.new("Scatter", "NODES").node_group = tree


@case
def hidden():
    cube("Shown")
    cube("Hidden object").hide_render = True
    store = bpy.data.collections.new("Store")
    bpy.context.scene.collection.children.link(store)
    store.objects.link(bpy.data.objects.new("In hidden collection", bpy.data.meshes["Shown"]))
    store.hide_render = True
    aside = bpy.data.collections.new("Aside")
    bpy.context.scene.collection.children.link(aside)
    aside.objects.link(bpy.data.objects.new("In excluded collection", bpy.data.meshes["Shown"]))
    bpy.context.view_layer.layer_collection.children["Aside"].exclude = True
    cube("Hidden in viewport only").hide_viewport = False
    bpy.data.objects["Hidden in viewport only"].hide_set(True)


@case
def materials_of_slots():
    names = ("Red", "Green", "Blue")
    red, green, blue = (bpy.data.materials.new(name) for name in names)
    box = cube("Two slots")
    box.data.materials.append(red)
    box.data.materials.append(green)
    for polygon in box.data.polygons:
        polygon.material_index = polygon.index % 2
    box.material_slots[1].link = "OBJECT"
    box.material_slots[1].material = blue
    past = cube("Index past the slots")
    past.data.materials.append(red)
    for polygon in past.data.polygons:
        polygon.material_index = 5
    cube("Bare")


@case
def material_override():
    cube("Any").data.materials.append(bpy.data.materials.new("Own"))
    bpy.context.view_layer.material_override = bpy.data.materials.new("Override")


@case
def shading():
    smooth = cube("Smooth")
    smooth.data.polygons.foreach_set("use_smooth", [True] * 6)
    cube("Flat")


@case
def not_surfaces():
    loose = bpy.data.meshes.new("Wire")
    loose.from_pydata([(0, 0, 0), (1, 0, 0)], [(0, 1)], [])
    link(loose, "Wire")
    link(bpy.data.lattices.new("Lattice"), "Lattice")
    link(bpy.data.volumes.new("Smoke"), "Smoke")
    link(None, "Empty")
    cube("Holdout").is_holdout = True
    cube("Unseen").visible_camera = False


@case
def blockers():
    """Turned, parented, subdivided, without faces; one that is an ordinary object again."""
    parent = link(None, "Parent", location=(10.0, 0.0, 0.0))
    blocker("Turned", rotation_euler=(math.pi / 2, 0.0, 0.0), scale=(1.0, 3.0, 1.0)).parent = parent
    blocker("Subdivided").modifiers.new("Subdivision", "SUBSURF").render_levels = 2
    bare = blocker("Bare").data
    bare.clear_geometry()
    bare.from_pydata([(0, 0, 0), (1, 0, 0)], [(0, 1)], [])
    blocker("Wall").antiradiance.is_blocker = False


@case
def muted_blocker():
    blocker("Muted", mute=True)
    blocker("Open")


@case
def solo_blocker():
    blocker("Open")
    blocker("Alone", solo=True)
    blocker("Alone but muted", solo=True, mute=True)


@case
def solo_in_another_scene():
    here = bpy.context.scene
    blocker("Open")
    elsewhere = blocker("Elsewhere", solo=True)
    here.collection.objects.unlink(elsewhere)
    bpy.data.scenes.new("Other").collection.objects.link(elsewhere)


@case
def animated_blocker():
    """Frame 2 of three: it has moved, and is no longer muted."""
    plane = blocker("Moving", mute=True)
    for frame, (x, mute) in enumerate(((0.0, True), (4.0, False), (8.0, True)), start=1):
        plane.location.x, plane.antiradiance.mute = x, mute
        plane.keyframe_insert("location", frame=frame)
        plane.keyframe_insert("antiradiance.mute", frame=frame)
    bpy.context.scene.frame_set(2)


@case
def instanced_blockers():
    """In a collection instance, at vertices, and by a modifier on an object that is none."""
    walls = bpy.data.collections.new("Walls")
    inside = blocker("Inside")
    walls.objects.link(inside)
    bpy.context.scene.collection.objects.unlink(inside)
    row = link(None, "Row", location=(10.0, 0.0, 0.0))
    row.instance_type, row.instance_collection = "COLLECTION", walls
    carrier = quad("Carrier")
    blocker("Small", scale=(0.1, 0.1, 0.1)).parent = carrier
    carrier.instance_type = "VERTS"
    carrier.show_instancer_for_render = False


@case
def linked_blockers():
    """A library's collection, as an instance and as an override that mutes one of its planes."""
    house = bpy.data.collections.new("House")
    for thing in (blocker("Linked plane"), cube("Linked wall")):
        house.objects.link(thing)
    library = str(FOLDER / "library.blend")
    bpy.data.libraries.write(library, {house})
    scene = recorder.empty_scene()
    with bpy.data.libraries.load(library, link=True) as (_there, wanted):
        wanted.collections = ["House"]
    house = wanted.collections[0]
    instance = link(None, "Instance", location=(10.0, 0.0, 0.0))
    instance.instance_type, instance.instance_collection = "COLLECTION", house
    own = house.override_hierarchy_create(scene, bpy.context.view_layer)
    own.objects["Linked plane"].antiradiance.mute = True


def expected_of_original(name):
    """(#triangles, area) of an object's own mesh in the current scene, by another route."""
    evaluated = bpy.data.objects[name].evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    mesh.calc_loop_triangles()
    triangles, area = len(mesh.loop_triangles), sum(t.area for t in mesh.loop_triangles)
    evaluated.to_mesh_clear()
    return {"triangles": triangles, "area": area}


def run(build):
    recorder.empty_scene()
    build()
    scene, warnings = recorder.sync()
    result = {"meshes": recorder.summary(scene), "warnings": warnings,
              "blockers": recorder.blockers_of(scene)}
    if build is text_curve_metaball:
        result["expected"] = {n: expected_of_original(n) for n in ("Text", "Pipe", "Ball")}
    if build is sheared_by_parents:
        # Written out: rotate 45, stretch y by 3, rotate 45.
        turn = Matrix.Rotation(math.pi / 4, 4, "Z")
        wanted = turn @ Matrix.Diagonal((1.0, 3.0, 1.0, 1.0)) @ turn
        result["matrix"] = scene.meshes[0]["matrix"]
        result["expected"] = np.array(wanted)
    return result


recorder.finish({name: run(build) for name, build in CASES.items()})
