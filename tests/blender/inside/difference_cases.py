# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the operator "Difference to Image" on renders of a plane that fills the picture.

argument: a folder for pictures. Result: {CASE: {"error": what the operator said, "" if it was
content; of its image "pixels" (h, w, 4) and "figures"; ...}}.
"""

import pathlib
import sys

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402
from recorder import material, quad  # noqa: E402

FOLDER = pathlib.Path(recorder.arguments()[0])
FIGURES = ("mean_first", "mean_second", "relative_rms", "largest")


def plane_scene():
    """A plane whose left half shines with radiance .2 and whose right half with .4."""
    scene = recorder.empty_scene()
    scene.render.engine = "ANTIRADIANCE"
    scene.render.resolution_x, scene.render.resolution_y = 8, 6
    for name, x, radiance in (("Left", -10, 0.2), ("Right", 10, 0.4)):
        half = quad(name, scale=(10, 10, 1), location=(x, 0, 0), rotation_euler=(np.pi / 2, 0, 0))
        half.data.materials.append(material(name, emission=(radiance,) * 3))
    return scene


def shine(name, radiance):
    node = bpy.data.materials[name].node_tree.nodes["Emission"]
    node.inputs["Color"].default_value = (radiance, radiance, radiance, 1)


def save_render(path, file_format="OPEN_EXR"):
    settings = bpy.context.scene.render.image_settings
    before = settings.file_format
    settings.file_format = file_format
    bpy.data.images["Render Result"].save_render(str(path), scene=bpy.context.scene)
    settings.file_format = before
    return bpy.data.images.load(str(path))


def compare():
    """Runs the operator; it raises with its message where it reports an error."""
    try:
        bpy.ops.render.antiradiance_difference()
    except RuntimeError as failure:
        return {"error": str(failure)}
    image = bpy.data.images["Antiradiance Difference"]
    pixels = np.array(image.pixels[:]).reshape(image.size[1], image.size[0], 4)
    return {"error": "", "pixels": pixels, "figures": {name: image[name] for name in FIGURES},
            "images": len([i for i in bpy.data.images if i.name.startswith("Antiradiance")])}


def before_any_render():
    plane_scene()
    return compare()


def no_image_chosen():
    plane_scene()
    bpy.ops.render.render()
    return compare()


def darker_and_brighter():
    """The left half gets darker, the right one brighter; the output's settings stay as they are."""
    scene = plane_scene()
    bpy.ops.render.render()
    scene.antiradiance_comparison.image = save_render(FOLDER / "first.exr")
    shine("Left", 0.18)
    shine("Right", 0.42)
    bpy.ops.render.render()
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth = "PNG", "16"
    result = compare()
    files = [image.name for image in bpy.data.images if image.name.startswith("render.exr")]
    return {**result, "output": (settings.file_format, settings.color_depth), "left": files}


def again_at_another_size():
    """After darker_and_brighter(): the same image is made over."""
    scene = bpy.context.scene
    scene.render.resolution_x = 12
    bpy.ops.render.render()
    wrong_size = compare()
    scene.antiradiance_comparison.image = save_render(FOLDER / "wide.exr")
    return {**compare(), "wrong_size": wrong_size["error"]}


def other_slot():
    """Slot 1 holds the first render, slot 2 the second, which is shown."""
    scene = plane_scene()
    scene.antiradiance_comparison.source = "SLOT"
    scene.antiradiance_comparison.slot = 1
    bpy.ops.render.render()
    slots = bpy.data.images["Render Result"].render_slots
    shown = compare()
    shine("Right", 0.2)
    slots.active_index = 1
    bpy.ops.render.render()
    result = {**compare(), "shown": shown["error"], "active": slots.active_index}
    scene.antiradiance_comparison.slot = 5
    return {**result, "empty": compare()["error"]}


def eight_bits():
    """A PNG of a render under the view transform Standard: equal up to its rounding."""
    scene = plane_scene()
    scene.view_settings.view_transform = "Standard"
    scene.render.dither_intensity = 0
    bpy.ops.render.render()
    scene.antiradiance_comparison.image = save_render(FOLDER / "eight.png", "PNG")
    return compare()


def undone():
    """The image comes and goes with undo and redo."""
    plane_scene()
    bpy.ops.render.render()
    bpy.context.scene.antiradiance_comparison.image = save_render(FOLDER / "undo.exr")
    bpy.ops.ed.undo_push(message="before")
    name = "Antiradiance Difference"
    states = []
    bpy.ops.render.antiradiance_difference("EXEC_DEFAULT", True)
    states.append(name in bpy.data.images)
    bpy.ops.ed.undo()
    states.append(name in bpy.data.images)
    return {**compare(), "states": states}


CASES = (before_any_render, no_image_chosen, darker_and_brighter, again_at_another_size,
         other_slot, eight_bits, undone)
recorder.finish({case.__name__: case() for case in CASES})
