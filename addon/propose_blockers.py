# SPDX-License-Identifier: GPL-3.0-or-later
"""Blocking planes in the walls of a scene, found and ranked without the artist."""
import bpy
import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree

from . import blockers, core, wall_planes
from .blocker_evaluation import read_scene
from .blocker_operators import NAME
from .properties import option_values
from .sync import read_mesh
from .ui import ENGINE

COLLECTION = "Blocking Planes"
SAME_PLACE = 0.01  # m, from a plane that is there
SAMPLES = 64       # points of a plane at which that is tested; more than half of them decide


class NothingFoundError(Exception):
    """Why there is no plane to add."""


class ANTIRADIANCE_OT_propose_blocking_planes(bpy.types.Operator):
    """Add blocking planes in the middle of walls that light reaches from both sides, the ones that
    cut the most links, with openings such as doors cut out"""
    bl_idname = "antiradiance.propose_blocking_planes"
    bl_label = "Propose Blocking Planes"
    bl_options = {"REGISTER", "UNDO"}

    thickness: bpy.props.FloatProperty(
        name="Thickness", description="Largest thickness of what counts as a wall",
        subtype="DISTANCE", default=wall_planes.THICKNESS, min=0.0, soft_min=0.01, soft_max=2.0)
    min_area: bpy.props.FloatProperty(
        name="Smallest Area", description="Area below which planes are not worth having",
        unit="AREA", default=wall_planes.MIN_AREA, min=wall_planes.SMALLEST_FACE, soft_max=10.0)
    limit: bpy.props.IntProperty(
        name="Number", description="How many planes to add at most", default=64, min=1,
        soft_max=256)

    only_helpful: bpy.props.BoolProperty(
        name="Only Helpful", default=True,
        description="Add only planes that bring the light of Implicit visibility nearer to that of "
                    "links tested with rays. Those of thin boards often do not, as light that "
                    "passes beside a board is cut as well. Takes as long as a few renders")

    @classmethod
    def poll(cls, context):
        if context.engine != ENGINE:
            cls.poll_message_set("Choose Antiradiance as the render engine first")
            return False
        if context.mode != "OBJECT":
            cls.poll_message_set("Blocking planes are added in Object Mode")
            return False
        return True

    def execute(self, context):
        manager = context.window_manager
        manager.progress_begin(0, 100)
        try:
            planes, share = choose(
                context, self.thickness, self.min_area, self.limit, self.only_helpful,
                lambda fraction, _stage: manager.progress_update(100 * fraction))
        except core.native.SceneError as failure:
            self.report({"ERROR"}, str(failure))
            return {"CANCELLED"}
        except NothingFoundError as reason:
            self.report({"WARNING"}, f"No blocking planes added: {reason}")
            return {"FINISHED"}  # so that the thickness can be adjusted
        finally:
            manager.progress_end()
        add_objects(context.scene, planes)
        self.report(*summary(len(planes), share, blockers.of_scene(context.scene)))
        return {"FINISHED"}


def summary(count, share, there):
    """(kind, text) of the report on `count` planes that cut that share of the links."""
    text = f"Added {count} blocking planes, which cut {100 * share:.1f} % of the links"
    if count == 1:
        text = f"Added a blocking plane, which cuts {100 * share:.1f} % of the links"
    solo = [thing.name for thing in there if thing.antiradiance.solo]
    if solo:
        return {"WARNING"}, f"{text}, but not while '{solo[0]}' is solo"
    return {"INFO"}, text


def choose(context, thickness, min_area, limit, only_helpful=False, progress=None):
    """([BlockingPlane], those first that cut the most links; the share of all links that they cut)
    """
    depsgraph = context.evaluated_depsgraph_get()
    walls = wall_planes.find_planes(core.native.lit_sides(read_scene(depsgraph)), thickness,
                                    min_area)
    if not walls:
        raise NothingFoundError("light reaches both sides of no wall of at most this thickness and "
                                "at least this area")
    there = tree_of(blockers.of_scene(context.scene))
    candidates = [plane for plane in walls if not coincides(plane, there)]
    if not candidates:
        raise NothingFoundError("the walls that were found have some already")
    options = option_values(context.scene.antiradiance)

    def evaluated(planes, **how):
        return evaluate(read_scene(depsgraph), planes, options, progress=progress, **how)

    def count(planes):
        rows, links = evaluated(planes)
        return np.array([row["links_cut"] for row in rows]), links

    planes, share = best_of(candidates, limit, count)
    if not planes:
        raise NothingFoundError("no other links cross the walls that were found")
    if only_helpful:
        rows, _links = evaluated(planes, light=True)
        helpful = [plane for plane, row in zip(planes, rows) if row["helps"]]
        if not helpful:
            raise NothingFoundError("none of the walls that were found would bring the light "
                                    "nearer to that of links tested with rays")
        if len(helpful) < len(planes):
            planes, share = best_of(helpful, limit, count)
    return planes, share


def best_of(planes, limit, count):
    """([plane], those first that cut the most links; the share of all links that they cut)
    count(planes) -> (#planes,) links that each cuts; the number of links without planes

    A link that crosses several planes counts for one of them alone. So no more than half of the
    planes are given up at once, before links are counted anew for the rest.
    """
    while True:
        links_cut, links = count(planes)
        useful = [i for i in np.argsort(-links_cut, kind="stable") if links_cut[i]]
        kept = useful[:max(limit, len(useful) // 2)]
        planes = [planes[i] for i in kept]
        if len(kept) == len(useful):
            return planes, links_cut.sum() / links


def evaluate(scene, planes, options, **how):
    """(what the core says of each plane, as it comes after the scene's own and those before it; the
    number of links that there are without planes)"""
    rows = []
    for plane in planes:
        matrix = np.eye(4, dtype=np.float32)
        matrix[:3, 3] = plane.centre
        rows.append(scene.add_blocker(
            NAME, positions=(plane.vertices - plane.centre).astype(np.float32), matrix=matrix,
            triangles=plane.triangles))
    found = core.native.evaluate_blockers(scene, options, rays=0, **how)
    return [found["per_plane"][row] for row in rows], max(1, found["links"])


def tree_of(objects) -> BVHTree:
    """Of the meshes as they are without modifiers, in world space."""
    corners = [np.empty((0, 3))]
    for thing in objects:
        mesh, matrix = read_mesh(thing.data), np.array(thing.matrix_world)
        corners.append(mesh.positions[mesh.triangles.ravel()] @ matrix[:3, :3].T + matrix[:3, 3])
    corners = np.concatenate(corners)
    return BVHTree.FromPolygons(corners.tolist(), np.arange(len(corners)).reshape(-1, 3).tolist(),
                                all_triangles=True)


def coincides(plane, tree) -> bool:
    """Whether more than half of the plane lies on the tree's triangles."""
    near = [tree.find_nearest(Vector(point), SAME_PLACE)[0] is not None
            for point in plane.sample(SAMPLES)]
    return sum(near) > len(near) / 2


def add_objects(scene, planes):
    """All of them or, should Blender refuse one, none."""
    made = []
    try:
        collection = next((child for child in scene.collection.children_recursive
                           if child.name == COLLECTION and child.library is None), None)
        if collection is None:
            collection = bpy.data.collections.new(COLLECTION)
            made.append(collection)
            scene.collection.children.link(collection)
        for plane in planes:
            mesh = bpy.data.meshes.new(NAME)
            made.append(mesh)
            mesh.from_pydata((plane.vertices - plane.centre).tolist(), [], plane.faces)
            thing = bpy.data.objects.new(NAME, mesh)
            made.append(thing)
            thing.location = plane.centre
            collection.objects.link(thing)
            thing.antiradiance.is_blocker = True
    except Exception:
        bpy.data.batch_remove(made)
        raise


CLASSES = (ANTIRADIANCE_OT_propose_blocking_planes,)
