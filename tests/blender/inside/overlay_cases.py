# SPDX-License-Identifier: GPL-3.0-or-later
"""Blocking planes in a 3D viewport that looks down on the ground, 12 m of it from left to right.

Result: {CASE: what its steps returned}. A drawing is told as {"red", "grey": {"pixels", "low",
"high"}}: how many pixels, and their extent about the view's centre in metres of the ground.
"""

import pathlib
import sys

import bpy
import gpu
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402
import windowed  # noqa: E402
from recorder import blocker, cube, link  # noqa: E402

WIDTH = 12.0  # m, of the view


def new_scene():
    """Nothing but blocking planes is drawn."""
    scene = recorder.empty_scene()
    bpy.data.objects.remove(scene.camera)
    scene.render.engine = "ANTIRADIANCE"
    with windowed.in_view():
        space = bpy.context.space_data
        overlay, view = space.overlay, space.region_3d
        for name in ("show_floor", "show_ortho_grid", "show_axis_x", "show_axis_y", "show_cursor",
                     "show_text", "show_object_origins", "show_outline_selected", "show_extras"):
            setattr(overlay, name, False)
        overlay.show_overlays, space.show_gizmo = True, False
        view.view_rotation, view.view_location = (1, 0, 0, 0), (0, 0, 0)
        view.view_perspective = "ORTHO"
        # The sensor is 32 mm wide and the lens 50 mm, as far as view_distance is concerned.
        view.view_distance = WIDTH * space.lens / 72
    return scene


def extent(mask):
    height, width = mask.shape
    rows, columns = np.nonzero(mask)
    if not len(rows):
        return {"pixels": 0}
    places = (np.stack([columns, rows], axis=1) - (width / 2, height / 2)) * (WIDTH / width)
    return {"pixels": len(rows), "low": places.min(axis=0), "high": places.max(axis=0)}


def drawn():
    red, green, blue, alpha = np.moveaxis(windowed.overlay(), 2, 0)
    drawn_on = alpha > 0.02
    is_red = (red - green > 0.05) & (np.abs(green - blue) < 0.05)
    return {"red": extent(drawn_on & is_red), "grey": extent(drawn_on & ~is_red)}


def undone():
    """Added by the operator as by its menu, undone, redone; after a cube was selected."""
    new_scene()
    thing = cube(size=3.0)
    thing.hide_set(False)
    with windowed.in_view():
        bpy.context.view_layer.update()
        thing.select_set(True)
        bpy.ops.ed.undo_push(message="before")
        bpy.ops.antiradiance.add_blocking_plane("INVOKE_DEFAULT", True)
    states = []
    for step in (None, bpy.ops.ed.undo, bpy.ops.ed.redo):
        if step is not None:
            with windowed.in_view():
                step()
        yield
        states.append({**drawn(), "objects": sorted(bpy.data.objects.keys())})
    return states


def from_face_undone():
    """From Edit Mode: the plane goes, the edit mode and the wall stay."""
    new_scene()
    wall = cube("Wall", scale=(1, 1, 0.1))
    wall.data.polygons.active = 5  # looks up
    with windowed.in_view():
        bpy.context.view_layer.objects.active = wall
        bpy.ops.ed.undo_push(message="before")
        bpy.ops.object.mode_set("EXEC_DEFAULT", True, mode="EDIT")
        bpy.ops.antiradiance.blocking_plane_from_face("EXEC_DEFAULT", True)
    yield
    states = [sorted(bpy.data.objects.keys())]
    with windowed.in_view():
        bpy.ops.ed.undo()
    yield
    states.append(sorted(bpy.data.objects.keys()))
    with windowed.in_view():
        states.append(bpy.context.mode)
        bpy.ops.ed.redo()
    yield
    return [*states, sorted(bpy.data.objects.keys())]


def sizes_on_invoke():
    """Of nothing; of what is selected; of the scene's surfaces but for planes."""
    sizes = []
    for selected in (None, "Low", ""):
        new_scene()
        if selected is not None:
            cube("Low", location=(-9, 0, 0), scale=(1, 1, 3), rotation_euler=(np.pi / 2, 0, 0))
            cube("High", location=(9, 0, 0))
            blocker("Far", location=(0, 500, 0))
        with windowed.in_view():
            bpy.context.view_layer.update()
            if selected:
                bpy.data.objects[selected].select_set(True)
            bpy.ops.antiradiance.add_blocking_plane("INVOKE_DEFAULT")
            sizes.append(bpy.context.object.dimensions.x)
    yield
    return sizes


def switched_off():
    """With whatever hides the plane, one after another; before and after it is seen."""
    scene = new_scene()
    plane, other = blocker("Plane"), blocker("Other", location=(0, 500, 0))
    with windowed.in_view():
        space = bpy.context.space_data

    def local_view(enter):
        with windowed.in_view():
            other.select_set(enter)
            bpy.ops.view3d.localview(frame_selected=False)

    ways = {
        "engine": lambda on: setattr(scene.render, "engine",
                                     "ANTIRADIANCE" if on else "BLENDER_WORKBENCH"),
        "overlays": lambda on: setattr(space.overlay, "show_overlays", on),
        "option": lambda on: setattr(scene.antiradiance_blockers, "show_blockers", on),
        "eye": lambda on: plane.hide_set(not on),
        "viewports": lambda on: setattr(plane, "hide_viewport", not on),
        "meshes": lambda on: setattr(space, "show_object_viewport_mesh", on),
        "local view": lambda on: local_view(not on),
        "no plane": lambda on: setattr(plane.antiradiance, "is_blocker", on),
    }
    seen = {}
    for name, switch in ways.items():
        states = []
        for on in (False, True):
            switch(on)
            yield
            states.append(drawn()["red"]["pixels"])
        seen[name] = states
    return seen


def parts():
    """Three planes: the first muted; then the last alone."""
    new_scene()
    planes = [blocker(name, location=(x, 0, 0)) for name, x in (("A", -4), ("B", -1), ("C", 2))]
    planes[0].antiradiance.mute = True
    yield
    muted = drawn()
    planes[0].antiradiance.mute = False
    planes[2].antiradiance.solo = True
    yield
    return {"muted": muted, "solo": drawn()}


def outlines():
    """Colours in which the rim of a plane is drawn: as it is, selected, active as well."""
    new_scene()
    plane = blocker("Plane", scale=(3, 3, 1))
    theme = bpy.context.preferences.themes[0].view_3d
    theme.object_selected, theme.object_active = (0, 1, 0), (0, 0, 1)
    colours = []
    for selected, active in ((False, None), (True, None), (True, plane)):
        plane.select_set(selected)
        bpy.context.view_layer.objects.active = active
        yield
        pixels = windowed.overlay()
        height, width, _ = pixels.shape
        column = width // 2 + round(3 * width / WIDTH)
        rim = pixels[height // 2, column - 2:column + 3]
        colours.append(rim[rim[:, 3].argmax()])
    return colours


def evaluated():
    """A modifier, an instance, and the plane while it is being edited."""
    new_scene()
    row = blocker("Row", location=(-4, 0, 0)).modifiers.new("Array", "ARRAY")
    row.count, row.relative_offset_displace = 2, (2, 0, 0)
    yield
    results = {"modifier": drawn()["red"]}
    new_scene()
    walls = bpy.data.collections.new("Walls")
    inside = blocker("Inside")
    walls.objects.link(inside)
    bpy.context.scene.collection.objects.unlink(inside)
    instance = link(None, "Instance", location=(2, 1, 0))
    instance.instance_type, instance.instance_collection = "COLLECTION", walls
    yield
    results["instance"] = drawn()["red"]
    instance.hide_set(True)
    yield
    results["hidden instance"] = drawn()["red"]
    corner = link(bpy.data.meshes.new("Corners"), "Corners")
    corner.data.from_pydata([(-4, 0, 0), (3, 0, 0)], [], [])
    corner.instance_type = "VERTS"
    blocker("Twice", scale=(0.5, 0.5, 1)).parent = corner
    yield
    results["two instances"] = drawn()["red"]
    new_scene()
    plane = blocker("Plane")
    with windowed.in_view():
        bpy.context.view_layer.objects.active = plane
        bpy.ops.object.mode_set(mode="EDIT")
        overlay = bpy.context.space_data.overlay
        overlay.show_faces = overlay.show_edge_crease = False
    yield
    results["edited"] = drawn()["red"]
    with windowed.in_view():
        bpy.ops.object.mode_set(mode="OBJECT")
    bare = blocker("Bare").data
    bare.clear_geometry()
    bpy.data.objects.remove(plane)
    yield
    results["bare"] = drawn()["red"]
    return results


def labels():
    """Pixels that a label adds at the plane's centre: with text, without, without figures."""
    scene = new_scene()
    blocker("Plane", location=(2, 1, 0))
    blocker("Not rendered", location=(-2, 1, 0))
    render_log = recorder.addon("render_log")
    yield
    before = windowed.overlay()
    render_log.remember(scene.name, render_log.Outcome(report={"blockers": {"per_plane": [
        {"name": "Plane", "links_cut": 1234567}]}}))
    yield
    without_text = windowed.overlay()
    with windowed.in_view():
        bpy.context.space_data.overlay.show_text = True
        bpy.context.preferences.view.show_object_info = False
        bpy.context.preferences.view.show_view_name = False
    yield
    with_text = windowed.overlay()
    render_log.clear()
    # A gradient behind the scene is dithered: steps of 1/255 mean nothing.
    return {name: extent((np.abs(pixels - before) > 0.1).any(axis=2))
            for name, pixels in (("without_text", without_text), ("with_text", with_text))}


def solo_in_local_view():
    """The plane that is alone is elsewhere, in a view of the other one only."""
    new_scene()
    plane = blocker("Plane")
    blocker("Alone", location=(0, 500, 0), solo=True)
    with windowed.in_view():
        bpy.context.view_layer.update()
        plane.select_set(True)
        bpy.ops.view3d.localview(frame_selected=False)
    yield
    shown = drawn()
    with windowed.in_view():
        bpy.ops.view3d.localview(frame_selected=False)
    return shown


def panels():
    """The names whose figures the Properties editor asks for when it draws, by tab."""
    scene = new_scene()
    plane = blocker("Plane")
    render_log, module = recorder.addon("render_log"), recorder.addon("blocker_panel")
    figures = {"links": 9, "links_cut": 5, "radiance_cut": 3, "occluded_cut": 4,
               "wrongly_cut": 1}
    render_log.remember_evaluation(scene.name, {**figures, "per_plane": [
        {"name": "Plane", **figures}]})
    with windowed.in_view():
        bpy.context.view_layer.objects.active = plane
    columns, asked = module.columns, {}
    for panel in (module.RENDER_PT_antiradiance_blockers,
                  module.OBJECT_PT_antiradiance_blocking_plane):
        bpy.utils.unregister_class(panel)
        panel.bl_options = set()  # open
        bpy.utils.register_class(panel)
    area = next(area for area in bpy.context.window_manager.windows[0].screen.areas
                if area.type == "PROPERTIES")
    for tab in ("RENDER", "OBJECT"):
        names = asked.setdefault(tab, [])
        module.columns = lambda context, name, names=names: names.append(name) or columns(context,
                                                                                          name)
        area.spaces.active.context = tab
        area.tag_redraw()
        yield
    module.columns = columns
    render_log.clear()
    return asked


def gpu_state():
    """What the next one who draws finds: as without the add-on's drawing."""
    new_scene()
    found = []

    def look():
        found.append((gpu.state.blend_get(), gpu.state.depth_test_get()))

    handler = bpy.types.SpaceView3D.draw_handler_add(look, (), "WINDOW", "POST_VIEW")
    yield
    without = found[-1]
    blocker("Plane")
    yield
    bpy.types.SpaceView3D.draw_handler_remove(handler, "WINDOW")
    return {"without": without, "with": found[-1], "drawn": drawn()["red"]["pixels"]}


CASES = (undone, from_face_undone, sizes_on_invoke, switched_off, parts, outlines, evaluated,
         labels, solo_in_local_view, panels, gpu_state)

windowed.drive_cases(CASES)
