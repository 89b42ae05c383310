# SPDX-License-Identifier: GPL-3.0-or-later
"""Final pictures in rendered viewports of the Cornell box, beside renders of the same cameras.

argument: folder for files. Result: {CASE: path of an .npz file with "viewport", the region's
pixels, "render", and "border", x0, y0, x1, y1 of the region that the render shows}.
"""

import math
import pathlib
import sys

import bpy
import numpy as np
from mathutils import Matrix

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import live_view  # noqa: E402
import recorder  # noqa: E402
import windowed  # noqa: E402

FOLDER = pathlib.Path(recorder.arguments()[0])
SCENE = pathlib.Path(__file__).resolve().parents[3] / "blend_scenes" / "cornell_box.blend"


def camera_zoom(share):
    """view_camera_zoom at which a frame of the region's shape has this share of its width."""
    return 50.0 * (2.0 * math.sqrt(share) - math.sqrt(2.0))


def open_scene():
    """Steps to the scene in a small view through its camera, whose frame fills the region."""
    bpy.ops.wm.open_mainfile(filepath=str(SCENE), load_ui=False)
    yield
    scene = bpy.context.scene
    scene.render.engine = "ANTIRADIANCE"
    scene.antiradiance.link_threshold = 0.1
    [(space, region)] = yield from live_view.small_views()
    render = scene.render
    render.resolution_x, render.resolution_y = region.width, region.height
    render.resolution_percentage = 100
    view = space.region_3d
    view.view_perspective = "CAMERA"
    view.view_camera_zoom, view.view_camera_offset = camera_zoom(1.0), (0, 0)
    space.overlay.show_overlays = space.use_render_border = False
    return scene, space, region


def rendered(scene, name):
    """(h, w, 4) f32 of a render of the scene, row 0 below, as a file holds it."""
    for setting, value in recorder.addon("compat").exact_file_settings(
            scene.render.image_settings).items():
        setattr(scene.render.image_settings, setting, value)
    scene.render.filepath = str(FOLDER / f"{name}.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    width, height = image.size
    pixels = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, 4)


def shown(space, region):
    """Steps to the pixels of the region, and the border of the picture in it."""
    space.shading.type = "RENDERED"
    yield from live_view.final(region)
    result = live_view.seen(region).pixels, live_view.viewport(region).picture.border
    space.shading.type = "SOLID"
    yield
    return result


def compared(name, viewport, render, border=None):
    height, width, _ = viewport.shape
    path = FOLDER / f"{name}.npz"
    np.savez(path, viewport=viewport, render=render, border=border or (0, 0, width, height))
    return str(path)


def through_the_camera():
    scene, space, region = yield from open_scene()
    pixels, _ = yield from shown(space, region)
    return compared("camera", pixels, rendered(scene, "camera"))


def border_of_the_camera():
    """The frame is half as large as the region, amidst of it; its border is a part of that."""
    scene, space, region = yield from open_scene()
    render, view = scene.render, space.region_3d
    # As many pixels to the left of the frame as to its right, and so on.
    width, height = (size // 2 + size // 2 % 2 + size % 2 for size in (region.width, region.height))
    render.resolution_x, render.resolution_y = width, height
    view.view_camera_zoom = camera_zoom(width / region.width)
    render.use_border = render.use_crop_to_border = True
    # The middle of a pixel's edge would be anyone's choice.
    render.border_min_x, render.border_max_x = (width // 4 + 0.1) / width, 1.0
    render.border_min_y, render.border_max_y = 0.0, (height // 2 + 0.1) / height
    pixels, border = yield from shown(space, region)
    return compared("border", pixels, rendered(scene, "border"), border)


def border_of_the_region():
    """Outside of the camera view, beside the picture of the whole region from there."""
    _scene, space, region = yield from open_scene()
    with live_view.in_view(region):
        bpy.ops.view3d.view_camera()
    yield
    whole, _ = yield from shown(space, region)
    space.use_render_border = True
    space.render_border_min_x, space.render_border_max_x = 0.25, 0.75
    space.render_border_min_y, space.render_border_max_y = 0.4, 0.8
    pixels, border = yield from shown(space, region)
    x0, y0, x1, y1 = border
    return compared("region_border", pixels, whole[y0:y1, x0:x1], border)


def orthographic():
    """A viewport that looks into the box, and an orthographic camera that sees the same."""
    scene, space, region = yield from open_scene()
    view = space.region_3d
    view.view_perspective = "ORTHO"
    view.view_rotation = scene.camera.matrix_world.to_quaternion()
    view.view_location, view.view_distance = (0.28, 0.28, 0.28), 2.0  # m: the box's middle
    yield
    pixels, _ = yield from shown(space, region)
    projection, to_world = np.array(view.window_matrix), view.view_matrix.inverted()
    camera = scene.camera
    camera.data.type, camera.data.sensor_fit = "ORTHO", "AUTO"
    camera.data.ortho_scale = 2.0 / min(projection[0, 0], projection[1, 1])
    camera.data.shift_x = camera.data.shift_y = 0.0
    camera.data.clip_end = 200.0
    camera.parent = None
    camera.constraints.clear()
    camera.matrix_world = to_world @ Matrix.Translation((0.0, 0.0, 100.0))
    return compared("orthographic", pixels, rendered(scene, "orthographic"))


def transparent_film():
    """From so far away that there is nothing around the box."""
    scene, space, region = yield from open_scene()
    scene.render.film_transparent = True
    camera = scene.camera
    camera.data.lens *= 0.5
    pixels, _ = yield from shown(space, region)
    return compared("transparent", pixels, rendered(scene, "transparent"))


CASES = (through_the_camera, border_of_the_camera, border_of_the_region, orthographic,
         transparent_film)

windowed.drive_cases(CASES, redraw=False)
