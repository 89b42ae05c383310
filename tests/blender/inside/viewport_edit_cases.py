# SPDX-License-Identifier: GPL-3.0-or-later
"""What an edit makes the solver of a rendered viewport do.

argument: folder for an image. Result: {EDIT: {"edits", "solutions": by how many each went up,
"stages": of the newest solution, "images read"}}.
"""

import pathlib
import sys

import bmesh
import bpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import live_view  # noqa: E402
import recorder  # noqa: E402
import windowed  # noqa: E402


IMAGE_FILE = pathlib.Path(recorder.arguments()[0]) / "floor.png"

images_read = []  # names, one a reading of pixels


def watch_images():
    images = recorder.addon("images")
    read = images.read_pixels

    def watched(image):
        images_read.append(image.name)
        return read(image)

    images.read_pixels = watched


def counted(region, edit, steps_after):
    """Steps to what edit() led to. steps_after(region, edit): makes it and waits for its end."""
    before = live_view.solver_state(region)
    images_read.clear()
    yield from steps_after(region, edit)
    after = live_view.solver_state(region)
    return {**{name: after[name] - before[name] for name in ("edits", "solutions")},
            "stages": live_view.report(region)["stages"], "images read": len(images_read)}


def set_color(material, value):
    material.node_tree.nodes[0].inputs["Color"].default_value = (*value, 1.0)


def textured_floor():
    """An image on the floor, in one colour."""
    image = bpy.data.images.new("Tiles", 4, 4)
    image.generated_color = (0.5, 0.5, 0.5, 1.0)
    tree = bpy.data.materials["Floor"].node_tree
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    tree.links.new(node.outputs["Color"], tree.nodes[0].inputs["Color"])
    return image


def image_edits(image):
    """Name -> edit of the image, in this order. Blender tells of some of them, or of none."""
    def told(change):
        def edit():
            change()
            bpy.context.scene.update_tag()
        return edit

    def paint():
        image.pixels[:] = [0.2, 0.4, 0.6, 1.0] * 16

    def load():
        image.filepath_raw, image.file_format = str(IMAGE_FILE), "PNG"
        image.save()
        image.source = "FILE"
        write_file((0.1, 0.1, 0.8, 1.0))
        image.reload()

    def load_again():
        write_file((0.9, 0.1, 0.1, 1.0))
        image.reload()

    return {
        "image generated": told(lambda: setattr(image, "generated_color", (0.1, 0.9, 0.1, 1.0))),
        "colour space": told(lambda: setattr(image.colorspace_settings, "name", "Non-Color")),
        "image painted": told(paint),
        "image loaded": told(load),
        "image loaded again": told(load_again),
    }


def write_file(colour):
    image = bpy.data.images.new("Other", 4, 4)
    image.pixels[:] = [*colour] * 16
    image.filepath_raw, image.file_format = str(IMAGE_FILE), "PNG"
    image.save()
    bpy.data.images.remove(image)


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
    watch_images()
    yield
    scene = live_view.lit_room()
    glowing = recorder.material("Glowing", emission=(1.0, 2.0, 3.0))
    recorder.quad("Panel", location=(-2, 0, 2)).data.materials.append(glowing)
    block, lamp, floor = (bpy.data.objects[name] for name in ("Block", "Lamp", "Floor"))
    image = textured_floor()
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
        **image_edits(image),
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
