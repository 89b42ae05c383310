# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors in 3D viewports: a text over the picture, which stays as it was before."""
import blf
import bpy
import gpu
from gpu_extras.batch import batch_for_shader

from . import live
from .ui import ENGINE
from .viewport_status import wrapped

TEXT_SIZE = 12.0       # px at Blender's own scale, as the lengths below
MARGIN, PADDING, SPACING = 20.0, 12.0, 1.5  # SPACING: of lines, in text sizes
WIDEST = 640.0
BACKGROUND, COLOUR = (0.22, 0.03, 0.03, 0.92), (1.0, 0.93, 0.9, 1.0)
FONT = 0

_handlers = []


def free_span(area, region):
    """(left, right) of the region, px, that no toolbar or sidebar lies over."""
    left, right = 0, region.width
    for other in area.regions:
        if other.type not in {"TOOLS", "UI"} or other.width <= 1:
            continue
        if other.alignment == "LEFT":
            left = max(left, other.x + other.width - region.x)
        else:
            right = min(right, other.x - region.x)
    return left, right


def draw_message():
    context = bpy.context
    if context.engine != ENGINE or context.space_data.shading.type != "RENDERED":
        return
    viewport = live.viewport_at(context.region)
    if viewport is None or not viewport.status.error:
        return
    scale = context.preferences.system.ui_scale
    left, right = free_span(context.area, context.region)
    blf.size(FONT, TEXT_SIZE * scale)
    room = min(right - left - 2 * (MARGIN + PADDING) * scale, WIDEST * scale)
    lines = wrapped(viewport.status.error, room, lambda text: blf.dimensions(FONT, text)[0])
    step = TEXT_SIZE * SPACING * scale
    width = max(blf.dimensions(FONT, line)[0] for line in lines)
    height = step * len(lines)
    x = (left + right - width) / 2
    y = (context.region.height - height) / 2
    pad = PADDING * scale
    draw_rectangle(x - pad, y - pad, x + width + pad, y + height + pad)
    blf.color(FONT, *COLOUR)
    for number, line in enumerate(lines, start=1):
        blf.position(FONT, x, y + height - number * step + 0.35 * TEXT_SIZE * scale, 0)
        blf.draw(FONT, line)


def draw_rectangle(left, bottom, right, top):
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    shader.uniform_float("color", BACKGROUND)
    corners = [(left, bottom, 0), (right, bottom, 0), (right, top, 0), (left, top, 0)]
    blend = gpu.state.blend_get()
    gpu.state.blend_set("ALPHA")
    batch_for_shader(shader, "TRIS", {"pos": corners},
                     indices=[(0, 1, 2), (0, 2, 3)]).draw(shader)
    gpu.state.blend_set(blend)


def register():
    if not bpy.app.background:
        _handlers.append(bpy.types.SpaceView3D.draw_handler_add(
            draw_message, (), "WINDOW", "POST_PIXEL"))


def unregister():
    for handler in _handlers:
        bpy.types.SpaceView3D.draw_handler_remove(handler, "WINDOW")
    _handlers.clear()
