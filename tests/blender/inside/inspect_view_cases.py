# SPDX-License-Identifier: GPL-3.0-or-later
"""What rendered viewports show of a solution beside its picture, and the links of picked patches.

A small viewport looks down on a floor of 8 m with a wall at its +X end; 12 m from left to right.
argument: folder for files. Result: {CASE: what its steps returned}.
"""

import pathlib
import sys

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import live_view  # noqa: E402
import recorder  # noqa: E402
import windowed  # noqa: E402

FOLDER = pathlib.Path(recorder.arguments()[0])
WIDTH = 12.0  # m, of the view
KINDS = ("needed", "occluded", "antiradiance")
inspection_panel, patch_links = recorder.addon("inspection_panel"), recorder.addon("patch_links")
PickPatch = recorder.addon("pick_patch").ANTIRADIANCE_OT_pick_patch

overlays = {}  # pointer of the region -> what lay over the scene in its last drawing
refusals = []  # what the operator told the artist
refuse = PickPatch._refuse
PickPatch._refuse = lambda self, reason: (refusals.append(reason), refuse(self, reason))[1]


def keep_overlay():
    overlays[bpy.context.region.as_pointer()] = windowed.read_pixels()


bpy.types.SpaceView3D.draw_handler_add(keep_overlay, (), "WINDOW", "POST_PIXEL")


def redrawn(region):
    """Steps until the region has been drawn as it is now."""
    before = len(live_view.seen(region).drawings)

    def is_drawn():
        """the region is drawn"""
        region.tag_redraw()
        # The drawing that is under way may have begun before.
        return len(live_view.seen(region).drawings) >= before + 2

    yield from windowed.until(is_drawn)


def walled_floor(visibility, block):
    """block: whether one hides most of the wall from a place 1.5 m to the -X side of the middle."""
    scene = live_view.lit_room()
    scene.antiradiance.visibility = visibility
    scene.antiradiance.max_patch_size = 1.0
    recorder.quad("Wall", scale=(1.5, 4, 1), location=(4, 0, 1.5),
                  rotation_euler=(0, -np.pi / 2, 0)).data.materials.append(
        recorder.material("Wall", albedo=(0.6,) * 3))
    thing = bpy.data.objects["Block"]
    thing.scale, thing.location.z = (0.5, 4, 0.5), 0.25
    if not block:
        bpy.data.objects.remove(thing)
    return scene


def look_down(space):
    for name in ("show_floor", "show_ortho_grid", "show_axis_x", "show_axis_y", "show_cursor",
                 "show_text", "show_object_origins", "show_outline_selected", "show_extras",
                 "show_relationship_lines"):
        setattr(space.overlay, name, False)
    space.show_gizmo = False
    view = space.region_3d
    view.view_rotation, view.view_location = (1, 0, 0, 0), (0, 0, 0)
    view.view_perspective = "ORTHO"
    # The sensor is 32 mm wide and the lens 50 mm, as far as view_distance is concerned.
    view.view_distance = WIDTH * space.lens / 72


def open_views(visibility, block, count=1):
    """Steps to [(space, region)] that show the final picture."""
    walled_floor(visibility, block)
    views = yield from live_view.small_views(count)
    for space, _region in views:
        look_down(space)
        space.shading.type = "RENDERED"
    yield from live_view.final(*(region for _space, region in views))
    return views


def inspected(space, region, **settings):
    """Steps to the final pixels after a change of the settings."""
    before = live_view.viewport(region).picture
    for name, value in settings.items():
        setattr(space.shading.antiradiance, name, value)

    def is_new():
        """there is a picture of other settings"""
        return live_view.viewport(region).picture is not before

    yield from windowed.until(is_new)
    yield from live_view.final(region)
    yield
    return live_view.seen(region).pixels


def pixel(region, x, y):
    """Where a place of the ground, m, is in the region."""
    scale = region.width / WIDTH
    return round(region.width / 2 + x * scale), round(region.height / 2 + y * scale)


def pick(region, x, y):
    with live_view.in_view(region):
        return sorted(bpy.ops.antiradiance.pick_patch(location=pixel(region, x, y)))


def place():
    found = patch_links.place_in(bpy.context.scene)
    return found and {"point": found.point, "normal": found.normal}


def lines(region):
    """Steps to how many pixels the overlay has in each colour of links."""
    yield from redrawn(region)
    pixels = overlays[region.as_pointer()]
    alpha = pixels[..., 3]
    red, green, blue = np.moveaxis(pixels[..., :3] / np.maximum(alpha, 1e-6)[..., None], 2, 0)
    drawn = alpha > 0.02
    return {"blue": np.sum(drawn & (blue > 0.7) & (red < 0.3)),
            "yellow": np.sum(drawn & (red > 0.7) & (green > 0.6) & (blue < 0.3)),
            "red": np.sum(drawn & (red > 0.7) & (green < 0.3) & (blue < 0.3)),
            "any": np.sum(drawn)}


def nearest_bin(solved, x, y, z):
    """The bin of light that travels along a vector."""
    return int(np.argmax([solved.bin_axis(b) @ (x, y, z) for b in range(solved.bin_count)]))


def views_of_open_room():
    """EXPLICIT without an occluder."""
    [(space, region)] = yield from open_views("EXPLICIT", block=False)
    solved = live_view.viewport(region).solver.solution()
    shown = {"OFF": live_view.seen(region).pixels}
    before = live_view.solver_state(region)["solutions"]
    for level in (0, 3):
        shown[f"level {level}"] = yield from inspected(space, region, view="HIERARCHY", level=level)
    for name, axis in (("from the wall", (-1, 0, -0.5)), ("upwards", (0, 0, 1))):
        shown[name] = yield from inspected(space, region, view="INCOMING_BIN",
                                           bin=nearest_bin(solved, *axis))
    for view in ("RESIDUAL", "EXPLICIT_DIFFERENCE"):
        shown[view] = yield from inspected(space, region, view=view)
    back = yield from inspected(space, region, view="OFF")
    np.savez(FOLDER / "open_room.npz", **shown, back=back)
    return {"file": str(FOLDER / "open_room.npz"),
            "solutions": [before, live_view.solver_state(region)["solutions"]]}


def beside_each_other():
    """Two viewports of one solution; each setting is its own, and a file keeps them."""
    views = yield from open_views("IMPLICIT", block=True, count=2)
    (space, region), (other_space, other_region) = views
    solver = live_view.viewport(region).solver
    before = solver.state()["solutions"]
    one = yield from inspected(space, region, view="HIERARCHY", level=1)
    other = yield from inspected(other_space, other_region, view="EXPLICIT_DIFFERENCE")
    np.savez(FOLDER / "beside.npz", one=one, other=other)
    result = {"file": str(FOLDER / "beside.npz"),
              "views": [s.shading.antiradiance.view for s, _region in views],
              "one solver": live_view.viewport(other_region).solver is solver,
              "solutions": [before, solver.state()["solutions"]]}
    space.shading.antiradiance.links_shown = 123
    file = str(FOLDER / "settings.blend")
    bpy.ops.wm.save_as_mainfile(filepath=file)
    other_space.shading.antiradiance.view = space.shading.antiradiance.view = "RESIDUAL"
    bpy.ops.wm.open_mainfile(filepath=file, load_ui=True)
    yield
    loaded = [s.shading.antiradiance for s, _region in live_view.views()[:2]]
    result["loaded"] = sorted([settings.view, settings.level, settings.links_shown]
                              for settings in loaded)
    return result


def picked_at():
    """On the floor, on the block, beside all; and before there is a solution."""
    walled_floor("EXPLICIT", block=True)
    [(space, region)] = yield from live_view.small_views()
    look_down(space)
    refusals.clear()
    space.shading.type = "RENDERED"
    result = {"too early": [pick(region, 0, 0), *refusals]}
    yield from live_view.final(region)
    for name, x, y in (("floor", -2, 1), ("block", 0.1, 0.3)):
        done = pick(region, x, y)
        result[name] = {"done": done, **place(), "expected": (x, y)}
    refusals.clear()
    result["beside"] = [pick(region, -5.5, 0), *refusals]
    result["kept"] = place()["point"] == result["block"]["point"]
    space.region_3d.view_perspective = "PERSP"
    space.region_3d.view_distance = 8.0
    yield
    with live_view.in_view(region):
        bpy.ops.antiradiance.pick_patch(location=(region.width // 2, region.height // 2))
    result["perspective"] = place()
    result["pixel"] = WIDTH / region.width
    return result


def clicked():
    """The operator as its button starts it: a click, Esc, a click elsewhere."""
    [(space, region)] = yield from open_views("EXPLICIT", block=True)
    window = bpy.context.window_manager.windows[0]
    corner = region.x, region.y

    def invoke():
        with live_view.in_view(region):
            return sorted(bpy.ops.antiradiance.pick_patch("INVOKE_DEFAULT"))

    def press(key, x, y):
        for kind, value in (("MOUSEMOVE", "NOTHING"), (key, "PRESS"), (key, "RELEASE")):
            window.event_simulate(type=kind, value=value, x=int(x), y=int(y))

    refusals.clear()
    x, y = pixel(region, -2, 1)
    result = {"invoked": invoke()}
    press("ESC", corner[0] + x, corner[1] + y)
    yield
    yield
    press("LEFTMOUSE", corner[0] + x, corner[1] + y)
    yield
    yield
    result["after Esc"] = place()
    invoke()
    press("LEFTMOUSE", corner[0] + x, corner[1] + y)
    yield
    yield
    result["picked"] = place()
    invoke()
    press("LEFTMOUSE", window.width - 5, window.height // 2)
    yield
    yield
    result["elsewhere"] = list(refusals)
    result["shows links"] = space.shading.antiradiance.show_links
    return result


def links_in_colours():
    """Of a place on the floor: all links, those of one kind, none."""
    result = {}
    for name, visibility, block in (("open", "EXPLICIT", False), ("behind", "IMPLICIT", True)):
        [(space, region)] = yield from open_views(visibility, block)
        settings = space.shading.antiradiance
        case = result[name] = {"before": (yield from lines(region))}
        pick(region, -1.5, 0)
        for shown in KINDS:
            for kind in KINDS:
                setattr(settings, f"show_{kind}", kind == shown)
            case[shown] = yield from lines(region)
        for kind in KINDS:
            setattr(settings, f"show_{kind}", True)
        case["all"] = yield from lines(region)
        settings.links_shown = 1
        case["one"] = yield from lines(region)
        space.overlay.show_overlays = False
        case["no overlays"] = yield from lines(region)
    return result


def undone_and_loaded():
    """The links follow the solution; a place outlives its patch, until another file is opened."""
    [(space, region)] = yield from open_views("EXPLICIT", block=True)
    pick(region, -2, 1)
    first = yield from lines(region)

    def links():
        return patch_links.links_in(live_view.viewport(region), bpy.context.scene, 300)

    result = {"links": [links()["total"]], "lines": [first["blue"]]}
    with live_view.in_view(region):
        bpy.ops.ed.undo_push(message="before")

    def remove_wall():
        with live_view.in_view(region):
            bpy.data.objects.remove(bpy.data.objects["Wall"])
            bpy.ops.ed.undo_push(message="without wall")

    def move_floor():
        with live_view.in_view(region):
            bpy.data.objects["Floor"].location.z = -0.5
            bpy.ops.ed.undo_push(message="floor below")

    def undo():
        with live_view.in_view(region):
            bpy.ops.ed.undo()

    for edit in (remove_wall, move_floor, undo, undo):
        yield from live_view.solved_anew(region, edit)
        shown = yield from lines(region)
        result["links"].append(links() and links()["total"])
        result["lines"].append(shown["blue"])
    walled_floor("EXPLICIT", block=True)
    yield
    result["place after loading"] = place()
    return result


def menu():
    """The colours that the menu explains, by view."""
    [(space, region)] = yield from open_views("IMPLICIT", block=True)
    pick(region, -2, 1)
    swatch, asked = inspection_panel.swatch, {}
    for view in ("OFF", "HIERARCHY", "INCOMING_BIN", "RESIDUAL", "EXPLICIT_DIFFERENCE"):
        colours_of_view = asked.setdefault(view, [])
        inspection_panel.swatch = lambda rgb, seen=colours_of_view: (
            seen.append(list(rgb)), swatch(rgb))[1]
        space.shading.antiradiance.view = view
        with live_view.in_view(region):
            bpy.ops.wm.call_panel("INVOKE_DEFAULT",
                                  name=inspection_panel.VIEW3D_PT_antiradiance_inspection.__name__)
        yield from redrawn(region)
    inspection_panel.swatch = swatch
    return {view: [list(colour) for colour in {tuple(c) for c in seen}]
            for view, seen in asked.items()}


CASES = (views_of_open_room, beside_each_other, picked_at, clicked, links_in_colours,
         undone_and_loaded, menu)

windowed.drive_cases(CASES)
