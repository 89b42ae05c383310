# SPDX-License-Identifier: GPL-3.0-or-later
"""Two rendered viewports of one scene; pause; errors.

Result: {CASE: what its steps returned}
"""

import pathlib
import sys

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import live_view  # noqa: E402
import recorder  # noqa: E402
import windowed  # noqa: E402

_overlays = {}  # pointer of the region -> what lies over its scene


def rendered_views(count=1):
    """Steps to `count` views of lit_room() with final pictures: (scene, [(space, region)])"""
    scene = live_view.lit_room()
    yield
    views = yield from live_view.small_views(count)
    for number, (space, _region) in enumerate(views):
        space.region_3d.view_perspective = "PERSP"
        space.region_3d.view_distance = 12.0 + 6.0 * number
        space.shading.type = "RENDERED"
    yield from live_view.final(*(region for _space, region in views))
    return scene, views


def two_views():
    """Do they share a solver; their pictures, by the lit share of the pixels; after an edit."""
    _scene, views = yield from rendered_views(2)
    regions = [region for _space, region in views]
    first, second = (live_view.viewport(region) for region in regions)
    result = {"shared": first.solver is second.solver,
              "lit": [lit_share(region) for region in regions],
              "solvers": len(live_view.live._solvers._solvers)}
    before = [brightness(region) for region in regions]
    yield from live_view.solved_anew(regions[0], brighten)
    yield from live_view.final(*regions)
    result["brighter"] = [brightness(region) / old for region, old in zip(regions, before)]
    return result


def brighten():
    bpy.data.lights["Lamp"].energy *= 2.0


def brightness(region):
    return live_view.seen(region).pixels[..., :3].max()


def lit_share(region):
    return (live_view.seen(region).pixels[..., :3].max(axis=2) > 0).mean()


def local_view():
    """In one of two views, and back; the block is edited in between."""
    _scene, views = yield from rendered_views(2)
    (_, local), (_, other) = views
    edits_of_other = live_view.solver_state(other)["edits"]

    def toggle():
        with live_view.in_view(local):
            for thing in bpy.context.view_layer.objects:
                thing.select_set(thing.name in {"Floor", "Lamp"})
            bpy.ops.view3d.localview(frame_selected=False)

    yield from live_view.updated(local, toggle)
    yield from live_view.final(local, other)
    first, second = (live_view.viewport(region) for region in (local, other))
    result = {"own": first.solver is not second.solver,
              "patches": [live_view.report(region)["patches"] for region in (local, other)],
              "edits of the other": live_view.solver_state(other)["edits"] - edits_of_other}
    yield from live_view.updated(local, toggle)
    yield from live_view.final(local, other)
    result["shared again"] = first.solver is second.solver
    yield from windowed.until(lambda: len(live_view.live._solvers._solvers) == 1)
    return result


def object_types():
    """Meshes hidden in a view: nothing is left to render; lamps hidden: it is dark."""
    _scene, [(space, region)] = yield from rendered_views()
    seen = {}
    for name in ("mesh", "light"):
        setattr(space, f"show_object_viewport_{name}", False)
        yield from live_view.updated(region, bpy.context.scene.update_tag)
        yield from windowed.until(lambda: not live_view.solver_state(region)["working"])
        state = live_view.solver_state(region)
        yield from windowed.until(lambda: live_view.is_final(region) or state["error"])
        seen[name] = {"error": state["error"], "lit": lit_share(region)}
        setattr(space, f"show_object_viewport_{name}", True)
    return seen


def paused():
    """An edit while paused, and the view turned; then it goes on. Nothing tells Blender's depsgraph
    of the pause."""
    scene, [(space, region)] = yield from rendered_views()
    solved = live_view.solver_state(region)["solutions"]
    dim = brightness(region)
    scene.antiradiance_viewport.pause = True
    yield from windowed.until(lambda: live_view.viewport(region).status.line.startswith("Paused"))
    yield from live_view.updated(region, brighten)
    picture = live_view.viewport(region).picture
    space.region_3d.view_distance *= 2.0
    yield from windowed.until(lambda: live_view.viewport(region).picture is not picture)
    result = {"solutions while paused": live_view.solver_state(region)["solutions"] - solved,
              "line": live_view.viewport(region).status.line}
    scene.antiradiance_viewport.pause = False
    yield from live_view.final(region)
    result["brighter"] = brightness(region) / dim
    result["line after"] = live_view.viewport(region).status.line
    return result


def missing_image():
    """An image that is not there, with overlays off; then it is taken out of the material."""
    _scene, [(space, region)] = yield from rendered_views()
    space.overlay.show_overlays = space.show_gizmo = False
    yield from windowed.until(lambda: region.as_pointer() in _overlays)
    tree = bpy.data.materials["Block"].node_tree
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = bpy.data.images.new("bricks", 8, 8)
    node.image.source, node.image.filepath = "FILE", "/nowhere/bricks.png"
    states = []
    diffuse = next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE")

    def look():
        behind = live_view.viewport(region)
        states.append({"error": behind.status.error, "line": behind.status.line,
                       "text pixels": int(text_pixels(region)), "lit": lit_share(region)})

    look()
    tree.links.new(node.outputs["Color"], diffuse.inputs["Color"])
    yield from windowed.until(lambda: live_view.viewport(region).status.error)
    yield
    look()
    tree.nodes.remove(node)
    yield from windowed.until(lambda: not live_view.viewport(region).status.error)
    yield from live_view.final(region)
    look()
    space.overlay.show_overlays = space.show_gizmo = True
    return states


def text_pixels(region):
    """How many of the text's own colour lie over the scene."""
    wanted = recorder.addon("viewport_message").COLOUR
    return (np.abs(_overlays[region.as_pointer()] - wanted) < 0.05).all(axis=2).sum()


def internal_error():
    """An exception of the add-on's own at each update: told once in the console, and cured."""
    _scene, [(_space, region)] = yield from rendered_views()
    sync, told = recorder.addon("sync"), []
    failures, write = recorder.addon("failures"), sync.SceneWriter.write
    print_exception = failures.traceback.print_exception
    failures.traceback.print_exception = told.append

    def fail(*_arguments, **_options):
        raise ZeroDivisionError("a bug")

    sync.SceneWriter.write = fail
    states = []
    for _edit in range(3):
        yield from live_view.updated(region, brighten)
        yield from windowed.until(lambda: live_view.viewport(region).status.error)
        states.append(live_view.viewport(region).status.error)
    sync.SceneWriter.write = write
    yield from live_view.solved_anew(region, brighten)
    failures.traceback.print_exception = print_exception
    return {"errors": states, "printed": len(told),
            "after": live_view.viewport(region).status.error}


def watch_overlays():
    bpy.types.SpaceView3D.draw_handler_add(_after_drawing, (), "WINDOW", "POST_PIXEL")


def _after_drawing():
    _overlays[bpy.context.region.as_pointer()] = windowed.read_pixels()


CASES = (two_views, local_view, object_types, paused, missing_image, internal_error)

windowed.drive_cases(CASES, redraw=False, begin=watch_overlays)
