# SPDX-License-Identifier: GPL-3.0-or-later
"""The links of the picked patch as lines in the rendered viewports, in the colours of Mückl &
Dachsbacher, Fig. 2: blue for light that arrives, yellow for light that goes through surfaces, red
for the antiradiance that takes it back. The more a link carries, the more opaque is its line.
"""
import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from . import core, inspection, live, patch_links

# By the id of the kind, as the screen shows them.
COLOURS = {"NEEDED": (0.05, 0.35, 1.0), "OCCLUDED": (1.0, 0.8, 0.0),
           "ANTIRADIANCE": (1.0, 0.05, 0.05)}
FAINTEST = 0.12    # alpha of what carries next to nothing
BEHIND = 0.3       # of the alpha, of what is behind a surface
LINE_WIDTH = 1.5   # px at Blender's own scale, as all lengths below
MARKS = ((4.0, (0.0, 0.0, 0.0, 0.8)), (2.0, (1.0, 1.0, 1.0, 1.0)))  # (width, colour), below first
RING = 8.0         # radius, about the centre of the patch: it may be too small to see
RING_CORNERS = 24

_handlers = []


def settings_in(context):
    """The settings of a viewport that shows links, else None."""
    if not (inspection.is_rendered(context) and context.space_data.overlay.show_overlays):
        return None
    settings = context.space_data.shading.antiradiance
    return settings if settings.show_links else None


def opacity(form_factors: np.ndarray) -> np.ndarray:
    """(n,) 0..1 by what each of the links carries; antiradiance below 0."""
    carried = np.abs(form_factors)
    return FAINTEST + (1.0 - FAINTEST) * np.sqrt(carried / carried.max(initial=1e-30))


def lines_of(patch: dict, settings):
    """(ends (2 n, 3) f32, colours (2 n, 4) f32) of the links that the settings show, those that
    carry the most last. patch: of the core's links_of()."""
    kinds = [kind for kind, *_ in core.native.link_kinds()]
    shown = np.array([getattr(settings, inspection.show_kind(kind)) for kind in kinds])
    links = np.flatnonzero(shown[patch["kind"]])[::-1]
    ends = np.stack([patch["from"][links], patch["to"][links]], axis=1).reshape(-1, 3)
    colours = np.empty((len(links), 4), np.float32)
    colours[:, :3] = np.array([COLOURS[kind] for kind in kinds])[patch["kind"][links]]
    colours[:, 3] = opacity(patch["form_factor"])[links]
    return ends, np.repeat(colours, 2, axis=0)


def draw_links():
    context = bpy.context
    settings = settings_in(context)
    if settings is None:
        return
    patch = patch_links.links_in(live.viewport_at(context.region), context.scene,
                                 settings.links_shown)
    if patch is None:
        return
    scale = context.preferences.system.ui_scale
    blend, depth_test = gpu.state.blend_get(), gpu.state.depth_test_get()
    gpu.state.blend_set("ALPHA")
    try:
        for test, share in (("GREATER", BEHIND), ("LESS_EQUAL", 1.0)):
            gpu.state.depth_test_set(test)
            draw_lines(*lines_of(patch, settings), share, LINE_WIDTH * scale)
        gpu.state.depth_test_set("NONE")
        draw_outline(patch["corners"], scale)
        draw_outline(ring_about(patch["center"], context, RING * scale), scale)
    finally:
        gpu.state.blend_set(blend)
        gpu.state.depth_test_set(depth_test)


def draw_lines(ends, colours, share, width):
    if not len(ends):  # which Blender can't make a batch of
        return
    shader = polyline_shader("POLYLINE_SMOOTH_COLOR", width)
    colours = colours * (1.0, 1.0, 1.0, share)
    batch_for_shader(shader, "LINES", {"pos": ends, "color": colours.astype(np.float32)}).draw(
        shader)


def ring_about(center, context, radius):
    """(RING_CORNERS, 3) that faces the viewer; radius: px."""
    view = context.region_data
    clip = np.array(view.perspective_matrix) @ (*center, 1.0)
    length = 2 * radius * clip[3] / (view.window_matrix[0][0] * context.region.width)  # m
    angles = np.linspace(0.0, 2 * np.pi, RING_CORNERS, endpoint=False)
    across = np.array(view.view_matrix)[:2, :3]  # to the right and upwards, in world space
    return center + length * np.stack([np.cos(angles), np.sin(angles)], axis=1) @ across


def draw_outline(corners, scale):
    """A closed line, white on black."""
    ends = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1).reshape(-1, 3)
    for width, colour in MARKS:
        shader = polyline_shader("POLYLINE_UNIFORM_COLOR", width * scale)
        shader.uniform_float("color", colour)
        batch_for_shader(shader, "LINES", {"pos": ends.astype(np.float32)}).draw(shader)


def polyline_shader(name, width):
    shader = gpu.shader.from_builtin(name)
    shader.uniform_float("lineWidth", width)
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    return shader


def register():
    if not bpy.app.background:  # there is no view to draw in, and no `gpu`
        _handlers.append(bpy.types.SpaceView3D.draw_handler_add(
            draw_links, (), "WINDOW", "POST_VIEW"))


def unregister():
    for handler in _handlers:
        bpy.types.SpaceView3D.draw_handler_remove(handler, "WINDOW")
    _handlers.clear()
