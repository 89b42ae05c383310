# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the last render differs from an earlier picture, as an image and in figures."""
import contextlib
import tempfile
from pathlib import Path

import bpy
import numpy as np

from . import compat, core, images
from .ui import EnginePanel

IMAGE_NAME = "Antiradiance Difference"
FIGURES = ("mean_first", "mean_second", "relative_rms", "largest")  # the image's properties
RENDER_SLOTS = 8  # Blender's


class ComparisonError(Exception):
    """What the artist has to do before there is something to compare."""


class AntiradianceComparison(bpy.types.PropertyGroup):
    """What the last render is compared with"""
    source: bpy.props.EnumProperty(
        name="Compare With", description="Where the earlier picture is",
        items=[("IMAGE", "Image", "An image of this file, such as a render that was saved", 0),
               ("SLOT", "Render Slot", "Another slot of the render result", 1)])
    image: bpy.props.PointerProperty(
        name="Image", description="The earlier picture", type=bpy.types.Image)
    slot: bpy.props.IntProperty(
        name="Slot", description="Number of the slot that holds the earlier picture", default=2,
        min=1, max=RENDER_SLOTS)


def render_result():
    """Blender's image of that kind; there is one at most."""
    return next((image for image in bpy.data.images if image.type == "RENDER_RESULT"), None)


@contextlib.contextmanager
def changed(owner, **values):
    """Properties of `owner` with other values for a while."""
    before = {name: getattr(owner, name) for name in values}
    try:
        for name, value in values.items():
            setattr(owner, name, value)
        yield
    finally:
        for name, value in before.items():
            setattr(owner, name, value)


def read_file(path) -> np.ndarray:
    image = bpy.data.images.load(str(path))
    try:
        return images.read_pixels(image)
    finally:
        bpy.data.images.remove(image)


def read_render_result(scene) -> np.ndarray:
    """(h, w, 4) float32 of the shown slot. Blender hands its pixels to a file only."""
    result, settings = render_result(), scene.render.image_settings
    with tempfile.TemporaryDirectory() as folder, changed(
            settings, **compat.exact_file_settings(settings)):
        path = Path(folder) / "render.exr"
        try:
            if result is None:
                raise RuntimeError
            result.save_render(str(path), scene=scene)
        except RuntimeError:
            number = "" if result is None else f" in slot {result.render_slots.active_index + 1}"
            raise ComparisonError(f"There is no render result{number}: render an image (F12) "
                                  "first") from None
        return read_file(path)


def read_slot(scene, number) -> np.ndarray:
    """number: 1.."""
    result = render_result()
    if result is not None and result.render_slots.active_index == number - 1:
        raise ComparisonError(f"Slot {number} is the one that is shown: choose the slot of the "
                              "earlier render, or show another in the Image Editor")
    if result is None:
        return read_render_result(scene)
    with changed(result.render_slots, active_index=number - 1):
        return read_render_result(scene)


def read_image(image) -> np.ndarray:
    if image is None:
        raise ComparisonError("There is no image to compare with: choose one in the panel Compare")
    if image.type in {"RENDER_RESULT", "MULTILAYER"}:
        kind = "the render result" if image.type == "RENDER_RESULT" else "a file of several layers"
        raise ComparisonError(f"Image '{image.name}' is {kind}, whose pixels Blender keeps to "
                              "itself: save it as OpenEXR and open that")
    if not (image.size[0] and image.size[1]):
        raise ComparisonError(f"Image '{image.name}' has no pixels: check its file")
    return images.read_pixels(image)


def write_image(pixels: np.ndarray):
    """The image of that name, new or made over. pixels: (h, w, 4) float32, linear"""
    height, width, _ = pixels.shape
    image = bpy.data.images.get(IMAGE_NAME)
    if image is None or image.source != "GENERATED" or not image.is_float:
        image = bpy.data.images.new(IMAGE_NAME, width, height, float_buffer=True)
    elif tuple(image.size) != (width, height):
        image.scale(width, height)
    image.pixels.foreach_set(pixels.reshape(-1))
    image.update()
    return image


class RENDER_OT_antiradiance_difference(bpy.types.Operator):
    """Make an image of where the last render differs from an earlier picture: red is darker, green
    is brighter, at four times the difference"""
    bl_idname = "render.antiradiance_difference"
    bl_label = "Difference to Image"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        scene = context.scene
        settings = scene.antiradiance_comparison
        try:
            second = read_render_result(scene)
            first = (read_image(settings.image) if settings.source == "IMAGE"
                     else read_slot(scene, settings.slot))
            difference = core.native.luminance_difference(first, second)
        except (ComparisonError, core.native.SceneError) as failure:
            self.report({"ERROR"}, str(failure))
            return {"CANCELLED"}
        if settings.source == "IMAGE" and not settings.image.is_float:
            self.report({"WARNING"}, f"Image '{settings.image.name}' holds what a display shows: "
                        "where its view transform was not Standard, all of it differs. Save "
                        "renders as OpenEXR to compare them")
        image = write_image(difference["pixels"])
        for name in FIGURES:
            image[name] = difference[name]
        self.report({"INFO"}, f"Image '{image.name}': " + ", ".join(
            f"{label} {value}" for label, value in figure_rows(image)))
        return {"FINISHED"}


def figure_rows(image):
    """(label, text) of what the operator has left on its image."""
    mean_first, mean_second, relative_rms, largest = (image[name] for name in FIGURES)
    return (("Relative RMS", f"{relative_rms:.4f}"), ("Largest", f"{largest:.4g}"),
            ("Mean", f"{mean_second:.4g}"), ("Mean Before", f"{mean_first:.4g}"))


class RENDER_PT_antiradiance_compare(EnginePanel, bpy.types.Panel):
    bl_label = "Compare"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, settings = self.layout, context.scene.antiradiance_comparison
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(settings, "source")
        layout.prop(settings, "image" if settings.source == "IMAGE" else "slot")
        layout.operator(RENDER_OT_antiradiance_difference.bl_idname, icon="IMAGE_DATA")
        image = bpy.data.images.get(IMAGE_NAME)
        if image is not None and all(name in image for name in FIGURES):
            column = layout.box().column(align=True)
            for label, value in figure_rows(image):
                split = column.split(factor=0.4)
                split.label(text=label)
                split.label(text=value)


CLASSES = (AntiradianceComparison, RENDER_OT_antiradiance_difference,
           RENDER_PT_antiradiance_compare)


def register_properties():
    bpy.types.Scene.antiradiance_comparison = bpy.props.PointerProperty(
        type=AntiradianceComparison)


def unregister_properties():
    del bpy.types.Scene.antiradiance_comparison
