# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that picks a patch with a click into a 3D viewport."""
import bpy
import numpy as np

from . import inspection, live, patch_links

HINT = "Pick Patch: click on a surface in a rendered viewport, Esc cancels"
NAVIGATION = ("MOUSEMOVE", "INBETWEEN_MOUSEMOVE", "MIDDLEMOUSE", "WHEEL", "TRACKPAD", "MOUSEPAN",
              "MOUSEZOOM", "MOUSEROTATE", "MOUSESMARTZOOM", "NUMPAD", "NDOF", "TIMER", "WINDOW")


def ray_through(region, view, x: float, y: float):
    """(origin, direction) of what a region shows at a pixel, from the near clipping plane on; m,
    world space. view: the region's RegionView3D."""
    to_world = np.linalg.inv(np.array(view.perspective_matrix, float))
    corner = 2 * x / region.width - 1, 2 * y / region.height - 1
    near, far = (to_world @ (*corner, depth, 1.0) for depth in (-1.0, 1.0))
    near, far = near[:3] / near[3], far[:3] / far[3]
    return near, far - near


def region_at(window, x: int, y: int):
    """The region of a rendered viewport at a place of the window, px; or None."""
    for its_window, region in live.rendered_regions():
        if (its_window == window and 0 <= x - region.x < region.width
                and 0 <= y - region.y < region.height):
            return region
    return None


class ANTIRADIANCE_OT_pick_patch(bpy.types.Operator):
    """Click on a surface to see the links that bring light to the patch there, and those that take
    it back"""
    bl_idname = "antiradiance.pick_patch"
    bl_label = "Pick Patch"
    bl_options = set()

    location: bpy.props.IntVectorProperty(
        name="Location", description="Pixel of the viewport's region, from its lower left corner",
        size=2, options={"SKIP_SAVE"})

    @classmethod
    def poll(cls, context):
        if context.space_data is None or not inspection.is_rendered(context):
            cls.poll_message_set("Switch a 3D viewport to rendered shading first")
            return False
        return True

    def invoke(self, context, _event):
        context.window.cursor_modal_set("EYEDROPPER")
        context.workspace.status_text_set(HINT)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type in {"ESC", "RIGHTMOUSE"}:
            self.cancel(context)
            return {"CANCELLED"}
        if event.type == "LEFTMOUSE" and event.value == "PRESS":
            self.cancel(context)
            return self._pick_under_mouse(context, event)
        return {"PASS_THROUGH"} if event.type.startswith(NAVIGATION) else {"RUNNING_MODAL"}

    def cancel(self, context):
        context.window.cursor_modal_restore()
        context.workspace.status_text_set(None)

    def execute(self, context):
        solved = patch_links.solution_of(live.viewport_at(context.region))
        if solved is None:
            return self._refuse("There is no light to look into yet: wait for the viewport's "
                                "first picture")
        place = patch_links.pick(solved, *ray_through(context.region, context.region_data,
                                                      *self.location))
        if place is None:
            return self._refuse("No surface that light reaches is there: pick another one")
        patch_links.remember(context.scene, place)
        context.space_data.shading.antiradiance.show_links = True
        return {"FINISHED"}

    def _pick_under_mouse(self, context, event):
        region = region_at(context.window, event.mouse_x, event.mouse_y)
        if region is None:
            return self._refuse("That is no 3D viewport in rendered shading: pick in one")
        self.location = event.mouse_x - region.x, event.mouse_y - region.y
        area = next(area for area in context.screen.areas if region in area.regions[:])
        with context.temp_override(area=area, region=region):
            return self.execute(bpy.context)

    def _refuse(self, reason):
        self.report({"WARNING"}, reason)
        return {"CANCELLED"}


CLASSES = (ANTIRADIANCE_OT_pick_patch,)
