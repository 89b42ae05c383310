# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator "Propose Blocking Planes".

argument: the folder of the scenes. Result: {CASE: what it returns}
"""

import pathlib
import sys
import time

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402
from recorder import blocker, cube, empty_scene  # noqa: E402

SCENES = pathlib.Path(recorder.arguments()[0])
blockers, core = recorder.addon("blockers"), recorder.addon("core")
propose_blockers, wall_planes = recorder.addon("propose_blockers"), recorder.addon("wall_planes")
propose = bpy.ops.antiradiance.propose_blocking_planes


def open_scene(name):
    bpy.ops.wm.open_mainfile(filepath=str(SCENES / f"{name}.blend"))
    bpy.context.scene.render.engine = "ANTIRADIANCE"


def planes():
    return blockers.of_scene(bpy.context.scene)


def counts():
    return [len(some) for some in (bpy.data.objects, bpy.data.meshes, bpy.data.collections)]


def of_scene(name):
    """What is added, and what it cuts when counted anew."""
    open_scene(name)
    before = counts()
    begin = time.perf_counter()
    propose(only_helpful=False, limit=32)
    seconds = time.perf_counter() - begin
    bpy.context.view_layer.update()
    scene = propose_blockers.read_scene(bpy.context.evaluated_depsgraph_get())
    options = recorder.addon("properties").option_values(bpy.context.scene.antiradiance)
    counted = core.native.evaluate_blockers(scene, options, rays=0)
    cut = {plane["name"]: plane["links_cut"] for plane in counted["per_plane"]}
    return {"planes": [{**described(plane), "links_cut": cut[plane.name]} for plane in planes()],
            "links": counted["links"], "links_cut": counted["links_cut"], "seconds": seconds,
            "made": np.subtract(counts(), before)}


# A triangle, lit from both sides.
SHEET = {"corners": np.array([[(0, 0, 0), (2, 0, 0), (2, 2, 0)]], np.float32),
          "front": np.ones(1, bool), "back": np.ones(1, bool)}


def described(plane):
    mesh = plane.data
    mesh.calc_loop_triangles()
    matrix = np.array(plane.matrix_world)
    points = np.array([vertex.co for vertex in mesh.vertices]) @ matrix[:3, :3].T + matrix[:3, 3]
    triangles = points[[triangle.vertices[:] for triangle in mesh.loop_triangles]]
    return {"name": plane.name, "display": plane.display_type, "origin": plane.location[:],
            "blocker": plane.antiradiance.is_blocker, "triangles": triangles,
            "collections": [collection.name for collection in plane.users_collection]}


def scenes():
    return {name: of_scene(name) for name in ("two_rooms", "corridor", "desks", "office")}


def evaluation(name, settings, **how):
    """What the core says of all planes that are proposed with these settings."""
    open_scene(name)
    propose(**settings)
    bpy.context.view_layer.update()
    scene = propose_blockers.read_scene(bpy.context.evaluated_depsgraph_get())
    options = recorder.addon("properties").option_values(bpy.context.scene.antiradiance)
    return core.native.evaluate_blockers(scene, options, light=True, **how)


def light():
    return {"corridor": evaluation("corridor", {"only_helpful": False}, rays=64, all_links=True),
            "office": evaluation("office", {"only_helpful": False, "limit": 32}, rays=0),
            "office, helpful": evaluation("office", {}, rays=0)}


def again():
    """With all planes there; with the wall's muted, 5 mm off its place, or gone."""
    open_scene("two_rooms")
    propose()
    result = {"first": len(planes())}
    propose()
    result["all_there"] = len(planes())
    wall = max(planes(), key=lambda plane: plane.dimensions.y * plane.dimensions.z)
    wall.antiradiance.mute = True
    propose()
    result["muted"] = len(planes())
    wall.antiradiance.mute = False
    wall.location.x += 0.005
    bpy.context.view_layer.update()
    propose()
    result["moved"] = len(planes())
    bpy.data.objects.remove(wall)
    propose()
    result["removed"] = len(planes())
    result["collections"] = [collection.name for collection in bpy.data.collections
                             if collection.name.startswith("Blocking")]
    return result


def settings():
    result = {}
    for name, values in {"limit": {"limit": 2}, "min_area": {"min_area": 1.5},
                         "thickness": {"thickness": 0.1}}.items():
        open_scene("two_rooms")
        propose(only_helpful=False, **values)
        result[name] = [described(plane) for plane in planes()]
    return result


def undone():
    open_scene("two_rooms")
    bpy.ops.ed.undo_push(message="before")
    propose("EXEC_DEFAULT", True)
    after = len(planes())
    bpy.ops.ed.undo()
    return after, len(planes()), "Blocking Planes" in bpy.data.collections


def failure_of(operator, **properties):
    """"" or the error that the operator ends with."""
    try:
        operator(**properties)
    except RuntimeError as error:
        return str(error)
    return ""


def refused():
    empty_scene()
    cube()
    result = {"other_engine": failure_of(propose)}
    bpy.context.scene.render.engine = "ANTIRADIANCE"
    bpy.context.view_layer.objects.active = bpy.data.objects["Cube"]
    bpy.ops.object.mode_set(mode="EDIT")
    result["edit_mode"] = failure_of(propose)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    result["nothing_there"] = failure_of(propose)
    return {**result, "planes": len(planes()),
            "collection": "Blocking Planes" in bpy.data.collections}


def why_nothing():
    """The reasons in words; the operator itself ends well, so that its settings can be changed."""
    def reason(**values):
        try:
            propose_blockers.choose(bpy.context, **{"thickness": 0.5, "min_area": 0.25, "limit": 9,
                                                    **values})
        except propose_blockers.NothingFoundError as error:
            return str(error)
        return ""

    open_scene("two_rooms")
    result = {"no_wall": reason(min_area=100.0)}
    propose(min_area=5.0)
    result["there"] = reason(min_area=5.0)
    result["ended"] = propose(min_area=5.0)
    propose()
    result["no_links"] = reason()
    return result


def half_made():
    """Blender refuses the second of two planes."""
    empty_scene()
    good, bad = (wall_planes.find_planes(SHEET)[0] for _ in range(2))
    bad.centre = bad.centre[:2]
    before, error = counts(), ""
    try:
        propose_blockers.add_objects(bpy.context.scene, [good, bad])
    except ValueError as failure:
        error = str(failure)
    return {"error": error, "before": before, "after": counts()}


def of_another_scene():
    """A collection of that name there is not the one to add to."""
    empty_scene()
    other = bpy.data.scenes.new("Other")
    other.collection.children.link(bpy.data.collections.new("Blocking Planes"))
    propose_blockers.add_objects(bpy.context.scene, wall_planes.find_planes(SHEET))
    return {"other": len(other.collection.all_objects), "here": len(planes())}


def chosen():
    """Of planes that are sets of links, by what best_of() is to know of them."""
    def count(planes):
        asked.append(len(planes))
        seen, cut = set(), []
        for plane in planes:
            cut.append(len(plane - seen))
            seen |= plane
        return np.array(cut), 100

    # Links 0-19 cross all of the first three; another plane alone cuts 8 others.
    small = [{50 + i} for i in range(8)]
    planes = [set(range(20)), set(range(21)), set(range(40)), set(range(40, 48)), *small, set()]
    result = {}
    for limit in (1, 2, 30):
        asked = []
        best, share = propose_blockers.best_of(planes, limit, count)
        result[limit] = {"sizes": [len(plane) for plane in best], "share": share, "asked": asked}
    return result


def said():
    empty_scene()
    plane = blocker(name="Old")
    result = [propose_blockers.summary(count, 0.4567, [plane]) for count in (1, 2)]
    plane.antiradiance.solo = True
    return [*result, propose_blockers.summary(2, 0.4567, [plane])]


recorder.finish({case.__name__: case() for case in (
    scenes, light, again, settings, undone, refused, why_nothing, half_made, of_another_scene,
    chosen, said)})
