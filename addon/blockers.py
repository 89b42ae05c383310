# SPDX-License-Identifier: GPL-3.0-or-later
"""Blocking planes: mesh objects that are not rendered and cut the links that cross them.

What an object carries (`object.antiradiance`), which objects take part, and what the last solution
and evaluation say of each.
"""
import bpy
import numpy as np

RAY_VISIBILITY = ("visible_camera", "visible_diffuse", "visible_glossy", "visible_transmission",
                  "visible_volume_scatter", "visible_shadow")

WRONG_SHARE = 0.01  # of a plane's links of light: how many may be cut wrongly before it is marked

# Of object types that have a surface, and so an extent that a plane can be made to match.
WITH_SURFACE = {"MESH", "CURVE", "SURFACE", "META", "FONT"}


def _is_blocker_changed(self, _context):
    """A plane is seen through in the viewport, and other engines do not render it."""
    thing = self.id_data
    thing.display_type = "WIRE" if self.is_blocker else "TEXTURED"
    for name in RAY_VISIBILITY:
        setattr(thing, name, not self.is_blocker)


def _part_changed(self, _context):
    """The viewport's evaluated copy takes over a property of an add-on only when told to."""
    self.id_data.update_tag()


class AntiradianceObject(bpy.types.PropertyGroup):
    """What the Antiradiance engine does with an object"""
    is_blocker: bpy.props.BoolProperty(
        name="Blocking Plane",
        description="Cut the links of light that cross this mesh, and do not render it. It should "
                    "lie inside a wall, where no light passes anyway",
        override={"LIBRARY_OVERRIDABLE"}, update=_is_blocker_changed)
    mute: bpy.props.BoolProperty(
        name="Mute", description="Let this blocking plane cut nothing; it is still not rendered",
        override={"LIBRARY_OVERRIDABLE"}, update=_part_changed)
    solo: bpy.props.BoolProperty(
        name="Solo", description="Let no blocking planes cut links but those with this setting",
        override={"LIBRARY_OVERRIDABLE"}, update=_part_changed)


class AntiradianceBlockers(bpy.types.PropertyGroup):
    """How a scene's blocking planes are shown"""

    # The list's active row is the active object: nothing of its own to keep, or to get out of step.
    def _get_active(self):
        active = bpy.context.view_layer.objects.active
        return -1 if active is None else self.id_data.objects.find(active.name)

    def _set_active(self, index):
        view_layer = bpy.context.view_layer
        thing = self.id_data.objects[index]
        if bpy.context.mode != "OBJECT" or view_layer.objects.get(thing.name) != thing:
            return  # another object is being edited, or the layer excludes this one
        for selected in list(view_layer.objects.selected):
            selected.select_set(False)
        thing.select_set(True)
        view_layer.objects.active = thing

    active_index: bpy.props.IntProperty(
        name="Blocking Plane", description="Select this blocking plane",
        get=_get_active, set=_set_active)
    show_blockers: bpy.props.BoolProperty(
        name="Show in Viewports", default=True,
        description="Draw blocking planes in red, those that take no part in grey, with the "
                    "number of links that they cut in the last render")


def is_blocker(thing) -> bool:
    return thing.type == "MESH" and thing.antiradiance.is_blocker


def taking_part(planes) -> list:
    """Those that cut links. planes: all blocking planes, anything with `mute` and `solo`"""
    planes = list(planes)
    any_solo = any(plane.solo for plane in planes)
    return [plane for plane in planes if not plane.mute and (plane.solo or not any_solo)]


def takes_part(thing, scene) -> bool:
    """Whether a blocking plane of the scene cuts links."""
    return thing.antiradiance in taking_part(plane.antiradiance for plane in of_scene(scene))


def of_scene(scene) -> list:
    """The blocking planes among the scene's objects."""
    return [thing for thing in scene.objects if is_blocker(thing)]


def darkens(figures: dict) -> bool:
    """Whether a plane, or all of them, takes away light that should be there, by an evaluation. Of
    the links that a plane in a wall cuts, a few pass through the joints between surfaces."""
    return figures["wrongly_cut"] > WRONG_SHARE * figures["radiance_cut"]


def figures_of(name: str, per_plane: list[dict]) -> dict | None:
    """The sum of what the core says of the object of that name and of its instances, or None."""
    of_object = [plane for plane in per_plane if plane["name"] == name
                 or plane["name"].startswith(f"{name} (instanced by ")]
    if not of_object:
        return None
    return {key: sum(plane[key] for plane in of_object) for key in of_object[0] if key != "name"}


def world_extent(objects) -> float:
    """m, the longest side of the world's box about those that have a surface; 0 if none has."""
    corners = [np.array(thing.bound_box) @ matrix[:3, :3].T + matrix[:3, 3] for thing, matrix in
               ((thing, np.array(thing.matrix_world)) for thing in objects
                if thing.type in WITH_SURFACE)]
    return float(np.ptp(np.concatenate(corners), axis=0).max()) if corners else 0.0


CLASSES = (AntiradianceObject, AntiradianceBlockers)


def register_properties():
    bpy.types.Object.antiradiance = bpy.props.PointerProperty(
        type=AntiradianceObject, override={"LIBRARY_OVERRIDABLE"})
    bpy.types.Scene.antiradiance_blockers = bpy.props.PointerProperty(type=AntiradianceBlockers)


def unregister_properties():
    del bpy.types.Scene.antiradiance_blockers
    del bpy.types.Object.antiradiance
