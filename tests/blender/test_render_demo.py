# SPDX-License-Identifier: GPL-3.0-or-later
"""packaging/render_demo.sh, the first command of the quick start, run from another folder."""

import os
import struct
import subprocess
import time

import pytest


@pytest.fixture
def render_demo(root, addon_folder, tmp_path):
    def run(*arguments):
        return subprocess.run(
            [root / "packaging" / "render_demo.sh", *arguments],
            cwd=tmp_path,
            capture_output=True,
            text=True,
            timeout=600,
            check=False,
        )

    return run


def save_scene(run_blender, path, expression):
    """Saves what `expression` makes of an empty scene with a camera."""
    script = (
        "import bpy;"
        "bpy.ops.wm.read_factory_settings(use_empty=True);"
        "camera = bpy.data.objects.new('Camera', bpy.data.cameras.new('Camera'));"
        "bpy.context.collection.objects.link(camera); bpy.context.scene.camera = camera;"
        f"{expression};"
        f"bpy.ops.wm.save_as_mainfile(filepath={str(path)!r})"
    )
    result = run_blender("--python-expr", script)
    assert result.returncode == 0, result.stdout


def test_default_scene_to_png(render_demo, tmp_path):
    result = render_demo()
    assert result.returncode == 0, result.stderr
    picture = result.stdout.splitlines()[-1]
    assert time.time() - os.path.getmtime(picture) < 60  # not the picture of an earlier run
    with open(picture, "rb") as file:
        head = file.read(24)
    assert head[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", head[16:24])
    assert width > 0 and height > 0


def test_relative_paths_and_exr(render_demo, root, tmp_path):
    scene = os.path.relpath(root / "blend_scenes" / "cornell_box.blend", tmp_path)
    result = render_demo(scene, "pictures/box.exr")
    assert result.returncode == 0, result.stderr
    picture = tmp_path / "pictures" / "box.exr"
    assert result.stdout.splitlines()[-1] == str(picture)
    assert picture.read_bytes()[:4] == b"\x76\x2f\x31\x01"  # OpenEXR's magic number


@pytest.mark.parametrize(
    "arguments, message",
    [
        (["missing.blend"], "missing.blend"),
        (["missing.blend", "out.jpg"], "must end in .png or .exr"),
        (["a", "b.png", "c"], "usage"),
    ],
)
def test_wrong_arguments(render_demo, tmp_path, arguments, message):
    result = render_demo(*arguments)
    assert result.returncode == 2
    assert message in result.stderr
    assert not result.stdout
    assert not list(tmp_path.iterdir())


def test_failed_render_keeps_the_old_picture_and_fails(render_demo, run_blender, tmp_path):
    save_scene(run_blender, tmp_path / "nothing.blend", "None")
    picture = tmp_path / "picture.png"
    picture.write_bytes(b"old")
    result = render_demo("nothing.blend", "picture.png")
    assert result.returncode == 1
    assert not result.stdout
    assert picture.read_bytes() == b"old"


def test_building_again_takes_under_ten_seconds(root, addon_folder):
    begin = time.monotonic()
    subprocess.run([root / "packaging" / "build.sh"], check=True, capture_output=True)
    assert time.monotonic() - begin < 10
