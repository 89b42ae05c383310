# SPDX-License-Identifier: GPL-3.0-or-later
"""Every difference between Blender 3.4, 4.3 and 5.2 that this add-on meets, and nothing else."""
import bpy
import numpy as np

# Outputs of a material can be meant for one engine; these are asked for in turn. 'CYCLES' also
# finds the outputs that are meant for all.
OUTPUT_TARGETS = ("CYCLES", "EEVEE")


def uses_nodes(owner) -> bool:
    """Of a material or world. From 5.0 on they always do, and `use_nodes` is on its way out."""
    if bpy.app.version >= (5, 0, 0):
        return owner.node_tree is not None
    return owner.use_nodes and owner.node_tree is not None


def output_node(tree):
    """The active Material, World or Light Output node, or None."""
    for target in OUTPUT_TARGETS:
        node = tree.get_output_node(target)
        if node is not None:
            return node
    return None


def corner_normals(mesh) -> np.ndarray:
    """(#loops, 3) float32: shading normals, object space."""
    normals = np.empty((len(mesh.loops), 3), np.float32)
    if hasattr(mesh, "corner_normals"):  # 4.1
        mesh.corner_normals.foreach_get("vector", normals.reshape(-1))
    else:
        mesh.calc_normals_split()
        mesh.loops.foreach_get("normal", normals.reshape(-1))
        mesh.free_normals_split()
    return normals


def is_shaded_flat(mesh) -> bool:
    """Whether every corner normal equals its face's."""
    if hasattr(mesh, "normals_domain"):  # 4.1
        return mesh.normals_domain == "FACE"
    smooth = np.empty(len(mesh.polygons), bool)
    mesh.polygons.foreach_get("use_smooth", smooth)
    return not smooth.any()


def uv_coordinates(layer) -> np.ndarray:
    """(#loops, 2) float32"""
    if hasattr(layer, "uv"):  # 3.5
        uv = np.empty((len(layer.uv), 2), np.float32)
        layer.uv.foreach_get("vector", uv.reshape(-1))
    else:
        uv = np.empty((len(layer.data), 2), np.float32)
        layer.data.foreach_get("uv", uv.reshape(-1))
    return uv


# Cycles 3.4 multiplies a spot's light by the cosine to its axis (measured); newer ones do not.
SPOT_HAS_COSINE = bpy.app.version < (4, 0, 0)


def lamp_scale(light, matrix_world) -> np.ndarray:
    """(3,) What multiplies colour x energy: 2^exposure, the colour of the temperature, and the
    lamp's area where its power is given per area (all new in 4.5 and 5.x)."""
    scale = np.ones(3)
    if hasattr(light, "exposure"):
        scale *= 2.0 ** light.exposure
    if getattr(light, "use_temperature", False):
        scale *= np.asarray(light.temperature_color[:])
    if not getattr(light, "normalize", True):
        scale *= light.area(matrix_world=matrix_world)
    return scale


def write_pass(render_pass, pixels: np.ndarray):
    """pixels: (h, w, channels) float32, C-contiguous, row 0 at the bottom."""
    height, width, channels = pixels.shape
    try:
        render_pass.rect.foreach_set(pixels.reshape(-1))  # 4.0 and later: flat
    except TypeError:
        render_pass.rect.foreach_set(pixels.reshape(width * height, channels))  # 3.x: pixel by row


def exact_file_settings(image_settings) -> dict:
    """name -> value, in the order to set them: a file that holds linear floats as they are."""
    values = {"file_format": "OPEN_EXR", "color_mode": "RGBA", "color_depth": "32",
              "exr_codec": "ZIP", "color_management": "FOLLOW_SCENE"}
    if hasattr(image_settings, "media_type"):  # 5.0: image or video, which sets the formats
        return {"media_type": "IMAGE", **values}
    return values


# Blender's own panels that show what this engine reads but that name the engines they are for.
# Panels that allow BLENDER_RENDER are taken as they are (ui.py); these are for EEVEE alone.
BORROWED_PANELS = (
    "EEVEE_MATERIAL_PT_context_material",
    "EEVEE_MATERIAL_PT_surface",
    "EEVEE_WORLD_PT_surface",
    "MATERIAL_PT_viewport",
)
