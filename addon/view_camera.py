# SPDX-License-Identifier: GPL-3.0-or-later
"""The view of a 3D viewport -> the core's camera, as the arguments of its set_camera()."""
import numpy as np

from .camera import view_frame

WHOLE = (0.0, 1.0, 0.0, 1.0)  # left, right, bottom, top of a border, in shares of what it is set in
FARTHEST = 1e6  # m, where the far plane is too far away for the matrix to tell


def depth_range(projection: np.ndarray, orthographic: bool):
    """(near, far) of an OpenGL projection matrix, m before the eye; below 0 is behind it."""
    scale, offset = projection[2, 2], projection[2, 3]
    if orthographic:  # depth -1 and 1 solved for -z: scale z + offset = -+1
        return (offset + 1.0) / scale, (offset - 1.0) / scale
    far = offset / (scale + 1.0) if scale < -1.0 else FARTHEST
    return offset / (scale - 1.0), min(far, FARTHEST)


def border_pixels(sides, width: int, height: int):
    """(x0, y0, x1, y1), row 0 below: what a region shows of the border, None if nothing. sides:
    left, right, bottom, top in shares of the region."""
    x0, x1 = (round(min(max(side, 0.0), 1.0) * width) for side in sides[:2])
    y0, y1 = (round(min(max(side, 0.0), 1.0) * height) for side in sides[2:])
    return (x0, y0, x1, y1) if x0 < x1 and y0 < y1 else None


def inside(border, frame, region_frame):
    """A border in shares of a camera's frame -> in shares of the region. Frames: view_frame() of
    both, which have the same eye."""
    def shares(sides, low, high, region_low, region_high):
        return [(low + side * (high - low) - region_low) / (region_high - region_low)
                for side in sides]

    return (*shares(border[:2], *frame[:2], *region_frame[:2]),
            *shares(border[2:], *frame[2:], *region_frame[2:]))


def camera_settings(projection, to_world, orthographic: bool, size, sides):
    """The arguments of set_camera(), None if no pixel is to be rendered.

    projection, to_world: (4, 4), of the region and of its eye. size: width and height of the
    region, pixels. sides: of the border, in shares of the region.
    """
    border = border_pixels(sides, *size)
    if border is None:
        return None
    left, right, bottom, top = view_frame(projection, orthographic)
    near, far = depth_range(projection, orthographic)
    matrix = np.array(to_world, np.float32)
    if near < 0.0:  # the eye of an orthographic viewport is amidst of what it shows
        matrix[:3, 3] -= matrix[:3, 2] * near
        near, far = 0.0, far - near
    return {"matrix": matrix, "type": "ORTHO" if orthographic else "PERSP",
            "width": size[0], "height": size[1], "left": left, "right": right, "bottom": bottom,
            "top": top, "clip_start": near, "clip_end": far, "border": border}


def border_sides(context, projection, depsgraph):
    """(left, right, bottom, top) of the border that the artist set, in shares of the region."""
    space, view = context.space_data, context.region_data
    if view.view_perspective != "CAMERA":
        return border_of(space, "render_border") if space.use_render_border else WHOLE
    render = context.scene.render
    camera = space.camera if space.use_local_camera else context.scene.camera
    if not render.use_border or camera is None:
        return WHOLE
    orthographic = not view.is_perspective
    of_camera = np.array(camera.calc_matrix_camera(
        depsgraph, x=render.resolution_x, y=render.resolution_y,
        scale_x=render.pixel_aspect_x, scale_y=render.pixel_aspect_y))
    return inside(border_of(render, "border"), view_frame(of_camera, orthographic),
                  view_frame(projection, orthographic))


def border_of(owner, prefix):
    return [getattr(owner, f"{prefix}_{side}") for side in ("min_x", "max_x", "min_y", "max_y")]


def camera_of(context, depsgraph):
    """camera_settings() of the viewport that the context is in; None if it shows nothing."""
    view, region = context.region_data, context.region
    projection = np.array(view.window_matrix)
    return camera_settings(
        projection, np.array(view.view_matrix.inverted()), not view.is_perspective,
        (region.width, region.height), border_sides(context, projection, depsgraph))
