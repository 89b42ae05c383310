# SPDX-License-Identifier: GPL-3.0-or-later
"""What makes blocking planes: from nothing, from objects that are there, from a wall's face."""
import bpy
from bpy_extras.object_utils import AddObjectHelper, object_data_add

from . import blockers, walls

NAME = "Blocking Plane"


def mark(objects, value: bool) -> list[str]:
    """Sets or clears `is_blocker`; (#problems,) what the artist has to know of the others."""
    problems = []
    for thing in objects:
        if thing.type != "MESH":
            problems.append(f"Object '{thing.name}': only meshes can be blocking planes, convert "
                            "it first")
        elif thing.library is not None:
            problems.append(f"Object '{thing.name}': it is linked from {thing.library.filepath}, "
                            "change it there or make a library override")
        elif thing.antiradiance.is_blocker != value:
            thing.antiradiance.is_blocker = value
    return problems


class ANTIRADIANCE_OT_add_blocking_plane(AddObjectHelper, bpy.types.Operator):
    """Add a plane that cuts the links of light which cross it, and is not rendered"""
    bl_idname = "antiradiance.add_blocking_plane"
    bl_label = "Blocking Plane"
    bl_options = {"REGISTER", "UNDO"}

    size: bpy.props.FloatProperty(
        name="Size", description="Length of the plane's sides", subtype="DISTANCE", default=2.0,
        min=1e-4, soft_min=0.01)

    @classmethod
    def poll(cls, context):
        if context.mode != "OBJECT":
            cls.poll_message_set("Blocking planes are added in Object Mode")
            return False
        return super().poll(context)

    def invoke(self, context, _event):
        others = [thing for thing in context.visible_objects if not blockers.is_blocker(thing)]
        extent = (blockers.world_extent(context.selected_objects)
                  or blockers.world_extent(others))
        if extent > 0:
            self.size = extent
        return self.execute(context)

    def execute(self, context):
        space = context.space_data
        if space is None or space.type != "VIEW_3D":
            self._align_without_view(context)
        half = self.size / 2
        mesh = bpy.data.meshes.new(NAME)
        mesh.from_pydata([(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)],
                         [], [(0, 1, 2, 3)])
        object_data_add(context, mesh, operator=self, name=NAME).antiradiance.is_blocker = True
        return {"FINISHED"}

    def _align_without_view(self, context):
        """From the Properties editor there is no view to align to, whatever was asked for."""
        wanted = (self.align if self.properties.is_property_set("rotation")
                  else context.preferences.edit.object_align)
        if wanted == "VIEW":
            self.align = "WORLD"
            self.rotation = (0, 0, 0)


class MarkOperator:
    bl_options = {"REGISTER", "UNDO"}
    value: bool  # of is_blocker

    @classmethod
    def poll(cls, context):
        if not context.selected_objects:
            cls.poll_message_set("Select the mesh objects first")
            return False
        return True

    def execute(self, context):
        objects = context.selected_objects
        problems = mark(objects, self.value)
        if problems:
            self.report({"WARNING"}, "\n".join(problems))
        return {"FINISHED"} if len(problems) < len(objects) else {"CANCELLED"}


class ANTIRADIANCE_OT_make_blocker(MarkOperator, bpy.types.Operator):
    """Let the selected meshes cut the links of light that cross them; they are drawn as wires and
    no longer rendered, nor are they in Cycles"""
    bl_idname = "antiradiance.make_blocker"
    bl_label = "Make Blocking Plane"
    value = True


class ANTIRADIANCE_OT_clear_blocker(MarkOperator, bpy.types.Operator):
    """Make ordinary, rendered objects of the selected blocking planes"""
    bl_idname = "antiradiance.clear_blocker"
    bl_label = "Clear Blocking Plane"
    value = False


class ANTIRADIANCE_OT_blocking_plane_from_face(bpy.types.Operator):
    """Put a blocking plane into the middle of a wall: of the outline of the active face and of
    those that continue it, half-way to the face on the wall's other side"""
    bl_idname = "antiradiance.blocking_plane_from_face"
    bl_label = "Blocking Plane from Face"
    bl_options = {"REGISTER", "UNDO"}

    thickness: bpy.props.FloatProperty(
        name="Wall Thickness", description="How far behind the face the wall's other side may be",
        subtype="DISTANCE", default=0.5, min=1e-4, soft_min=0.01, soft_max=2.0)

    @classmethod
    def poll(cls, context):
        thing = context.active_object
        if thing is None or thing.type != "MESH":
            cls.poll_message_set("Select the wall, a mesh, with the face of interest active")
            return False
        return context.mode in {"OBJECT", "EDIT_MESH"}

    def execute(self, context):
        wall = context.active_object
        wall.update_from_editmode()
        try:
            face = walls.active_face(wall)
        except walls.NoFaceError as failure:
            self.report({"ERROR"}, str(failure))
            return {"CANCELLED"}
        if wall.mode == "EDIT":  # whose undo steps hold no new objects
            bpy.ops.object.mode_set(mode="OBJECT")
        depth = walls.depth(wall, face, self.thickness, context.evaluated_depsgraph_get())
        mesh, matrix = walls.make_plane(NAME, wall, face, depth or 0.0)
        plane = object_data_add(context, mesh, name=NAME)
        plane.matrix_world = matrix
        plane.antiradiance.is_blocker = True
        if depth is None:
            limit = bpy.utils.units.to_string(context.scene.unit_settings.system, "LENGTH",
                                              self.thickness)
            self.report({"WARNING"}, f"Object '{plane.name}': it lies on the face, as there is no "
                        f"other side of '{wall.name}' within {limit}. Move it into the wall, or "
                        "raise Wall Thickness")
        return {"FINISHED"}


CLASSES = (ANTIRADIANCE_OT_add_blocking_plane, ANTIRADIANCE_OT_make_blocker,
           ANTIRADIANCE_OT_clear_blocker, ANTIRADIANCE_OT_blocking_plane_from_face)
