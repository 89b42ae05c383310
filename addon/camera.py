# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's camera and frame -> the core's."""
from dataclasses import dataclass

import numpy as np


class CameraError(Exception):
    """The camera cannot be rendered with; the text says why and what to do."""


@dataclass(frozen=True)
class Frame:
    """Pixels: the full picture and the part of it to render, [x0, x1) x [y0, y1), row 0 below."""
    width: int
    height: int
    border: tuple[int, int, int, int]

    @property
    def size(self):
        """(width, height) of the part to render"""
        x0, y0, x1, y1 = self.border
        return x1 - x0, y1 - y0


def frame_of(render, width: int, height: int) -> Frame:
    """`render`: RenderSettings; width, height: the engine's full resolution in pixels."""
    if not render.use_border:
        return Frame(width, height, (0, 0, width, height))
    # Blender multiplies in single precision and truncates; one pixel off and the result is refused.
    sides = [np.float32(side) * np.float32(extent)
             for side, extent in ((render.border_min_x, width), (render.border_min_y, height),
                                  (render.border_max_x, width), (render.border_max_y, height))]
    return Frame(width, height, tuple(int(side) for side in sides))


def view_frame(projection: np.ndarray, orthographic: bool):
    """(left, right, bottom, top) of an OpenGL projection matrix: on the plane at distance 1 for a
    perspective, in metres for an orthographic one. Holds shift, aspect and sensor fit."""
    def sides(row):
        # Clip coordinate -1 and 1 solved for x (or y): p x + q w = +-w, with w = -z = 1 or w = 1.
        scale, offset = projection[row, row], projection[row, 3 if orthographic else 2]
        offset = offset if orthographic else -offset
        return (-1.0 - offset) / scale, (1.0 - offset) / scale

    return (*sides(0), *sides(1))


def set_camera(scene, engine, depsgraph, camera_object, frame: Frame):
    """Sets the core's camera. `engine`: for the view of a stereo render, which moves the camera."""
    if camera_object is None:
        raise CameraError("The scene has no camera: add one, or make one active with Ctrl Numpad 0")
    camera = camera_object.data
    if camera_object.type != "CAMERA" or camera.type not in {"PERSP", "ORTHO"}:
        kind = camera.type.lower() if camera_object.type == "CAMERA" else "non-camera"
        raise CameraError(f"Camera '{camera_object.name}': a {kind} view cannot be rendered, "
                          "set its type to Perspective or Orthographic")
    render = depsgraph.scene.render
    projection = np.array(camera_object.calc_matrix_camera(
        depsgraph, x=frame.width, y=frame.height,
        scale_x=render.pixel_aspect_x, scale_y=render.pixel_aspect_y))
    left, right, bottom, top = view_frame(projection, camera.type == "ORTHO")
    stereo = camera.shift_x - engine.camera_shift_x(camera_object)
    if stereo:  # off-axis stereo shifts the frame, in units of its larger side
        move = -stereo * max(right - left, top - bottom)
        left, right = left + move, right + move
    scene.set_camera(
        view_matrix(engine, camera_object), type=camera.type, width=frame.width,
        height=frame.height, left=left, right=right, bottom=bottom, top=top,
        clip_start=camera.clip_start, clip_end=camera.clip_end, border=frame.border)


def view_matrix(engine, camera_object) -> np.ndarray:
    """(4, 4) camera to world, without the object's scale, as Blender renders it."""
    from mathutils import Matrix  # not at the top: the rest of this file runs without Blender
    matrix = engine.camera_model_matrix(camera_object)
    if matrix is None:
        matrix = camera_object.matrix_world
    location, rotation, _scale = Matrix(matrix).decompose()
    return np.array(Matrix.Translation(location) @ rotation.to_matrix().to_4x4(), np.float32)
