# SPDX-License-Identifier: GPL-3.0-or-later
"""What an edit makes the solver of a rendered viewport do.

Result: {EDIT: {"edits", "solutions": by how many each went up, "stages": of the newest solution}}
and {"exposure", "view transform", "selection", "camera"}: the same.
"""

import pathlib
import sys

import bmesh
import bpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import live_view  # noqa: E402
import recorder  # noqa: E402
import windowed  # noqa: E402


def counted(region, edit, steps_after):
    """Steps to what edit() led to. steps_after(region, edit): makes it and waits for its end."""
    before = live_view.solver_state(region)
    yield from steps_after(region, edit)
    after = live_view.solver_state(region)
    return {**{name: after[name] - before[name] for name in ("edits", "solutions")},
            "stages": live_view.stages(region)}


def set_color(material, value):
    material.node_tree.nodes[0].inputs["Color"].default_value = (*value, 1.0)


def move_vertex():
    """Of the block, which is in Edit Mode."""
    mesh = bpy.data.objects["Block"].data
    bmesh.from_edit_mesh(mesh).verts[:][0].co.x -= 0.3
    bmesh.update_edit_mesh(mesh)


def in_object(region, operator, **arguments):
    block = bpy.data.objects["Block"]
    with live_view.in_view(region):
        bpy.context.view_layer.objects.active = block
        operator(**arguments)


def steps():
    yield
    scene = live_view.lit_room()
    glowing = recorder.material("Glowing", emission=(1.0, 2.0, 3.0))
    recorder.quad("Panel", location=(-2, 0, 2)).data.materials.append(glowing)
    block, lamp, floor = (bpy.data.objects[name] for name in ("Block", "Lamp", "Floor"))
    block.modifiers.new("Bevel", "BEVEL").width = 0.01
    [(space, region)] = yield from live_view.small_views()
    space.shading.type = "RENDERED"
    yield from live_view.final(region)

    emission = glowing.node_tree.nodes[0].inputs["Strength"]
    colour = bpy.data.materials["Block"]
    edits = {
        "lamp energy": lambda: setattr(lamp.data, "energy", 150.0),
        "lamp colour": lambda: setattr(lamp.data, "color", (1.0, 0.5, 0.2)),
        "material colour": lambda: set_color(colour, (0.5, 0.2, 0.1)),
        "emission strength": lambda: setattr(emission, "default_value", 2.0),
        "object moved": lambda: setattr(block, "location", (0.5, 0, 0.5)),
        "modifier changed": lambda: setattr(block.modifiers[0], "width", 0.1),
        "object hidden": lambda: block.hide_set(True),
        "object shown": lambda: block.hide_set(False),
        "option by script": lambda: setattr(scene.antiradiance, "link_threshold", 0.2),
    }
    results = {}
    for name, edit in edits.items():
        results[name] = yield from counted(region, edit, live_view.solved_anew)
    in_object(region, bpy.ops.object.mode_set, mode="EDIT")
    yield from live_view.final(region)
    results["vertex in Edit Mode"] = yield from counted(region, move_vertex, live_view.solved_anew)
    in_object(region, bpy.ops.object.mode_set, mode="OBJECT")
    yield from live_view.final(region)

    def without_effect(region, edit):
        yield from live_view.updated(region, edit)
        yield from live_view.final(region)

    for name, edit in {
        "exposure": lambda: setattr(scene.view_settings, "exposure", 1.0),
        "view transform": lambda: setattr(scene.view_settings, "view_transform", "Raw"),
        "selection": lambda: floor.select_set(True),
        "camera": lambda: setattr(scene.camera, "location", (0, -9, 0)),
    }.items():
        results[name] = yield from counted(region, edit, without_effect)
    return results


windowed.drive(steps, redraw=False)
