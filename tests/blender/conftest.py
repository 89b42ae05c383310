# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives Blender from outside: `in_blender` runs a script of inside/, `in_window` one that needs a
window, `render` makes a picture, `pictures` those of a scene in several modes."""

import functools
import json
import pathlib
import shutil
import sys
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import pytest
from multilayer import read_multilayer

INSIDE = pathlib.Path(__file__).parent / "inside"
ROOT = pathlib.Path(__file__).resolve().parents[2]
IMAGES = ROOT / "tests" / "images"
sys.path.insert(0, str(IMAGES))
from compare import read_rgb  # noqa: E402

REFERENCES = json.loads((IMAGES / "references.json").read_text())


@pytest.fixture(scope="session")
def in_blender(run_blender, tmp_path_factory):
    """in_blender("script.py", *arguments, options=()) -> what the script gave to recorder.finish().

    options: of Blender's own command line.
    """

    def run(script, *arguments, timeout=300, window=False, options=()):
        output = tmp_path_factory.mktemp("inside") / "result.json"
        done = run_blender(*options, "-P", INSIDE / script, "--", output, *arguments, timeout=timeout,
                           window=window)
        assert done.returncode == 0, done.stdout
        # What fails while Blender draws is only printed.
        assert not window or "Traceback" not in done.stdout, done.stdout
        assert output.exists(), f"{script} gave no result:\n{done.stdout}"
        return json.loads(output.read_text())

    return run


@pytest.fixture(scope="session")
def in_window(in_blender):
    """in_window("script.py", *arguments): as in_blender, for scripts that drive inside/windowed.py"""
    if shutil.which("xvfb-run") is None:
        pytest.skip("xvfb-run is missing: apt-get install xvfb xauth")
    return functools.partial(in_blender, window=True)


@dataclass
class Picture:
    """One of a scene's pictures in several modes."""

    path: pathlib.Path
    report: dict

    @cached_property
    def pixels(self):
        return read_rgb(self.path)


@pytest.fixture(scope="session")
def pictures(in_blender, tmp_path_factory):
    """pictures(scene, modes, percentage=None) -> {mode: Picture}

    scene: the name of one of blend_scenes/. modes: {mode: options of scene.antiradiance}, rendered
    in one Blender and once a session. percentage: of the scene's resolution, by default as Cycles'
    picture in tests/images has it.
    """
    done = {}

    def of(scene, modes, percentage=None):
        percentage = percentage or REFERENCES[scene]["percentage"]
        cases = json.dumps(modes)
        key = scene, cases, percentage
        if key not in done:
            folder = tmp_path_factory.mktemp(scene)
            file = ROOT / "blend_scenes" / f"{scene}.blend"
            reports = in_blender("render_modes.py", file, percentage, folder, cases, timeout=900)
            done[key] = {mode: Picture(folder / f"{mode}.exr", reports[mode]) for mode in modes}
        return done[key]

    return of


@dataclass
class Rendered:
    """One `blender -b ... -f`. Pictures have row 0 at the top, as files have."""

    exit_code: int
    log: str
    report: dict | None  # the JSON report, None if none was written
    passes: dict[str, np.ndarray] = field(default_factory=dict)  # name -> (h, w[, channels])
    picture_files: tuple[pathlib.Path, ...] = ()

    @property
    def combined(self):
        return self.passes["Combined"]


@pytest.fixture
def render(run_blender, tmp_path):
    """render(scene, python="", frame=1, **options) -> Rendered.

    scene: a .blend file, or a script of inside/ that builds one. python: run before rendering, with
    `scene` the scene. options: properties of scene.antiradiance.
    """
    counter = iter(range(1000))

    def run(scene, python="", frame=1, arguments=(), timeout=600, **options):
        folder = tmp_path / f"render_{next(counter)}"
        folder.mkdir()
        options.setdefault("report_path", str(folder / "report.json"))
        lines = ["import bpy", "scene = bpy.context.scene", *python.splitlines()]
        lines += [f"scene.antiradiance.{name} = {value!r}" for name, value in options.items()]
        set_up = folder / "set_up.py"
        set_up.write_text("\n".join(lines) + "\n")
        scene = pathlib.Path(scene)
        opening = [scene] if scene.suffix == ".blend" else ["-P", INSIDE / scene]
        done = run_blender(
            *opening, "-E", "ANTIRADIANCE", "-P", set_up, "-o", folder / "frame_",
            "-F", "OPEN_EXR_MULTILAYER", "-x", "1", "-f", frame, "--", *arguments, timeout=timeout,
        )
        report = pathlib.Path(options["report_path"])
        pictures = tuple(sorted(folder.glob("frame_*")))
        return Rendered(
            exit_code=done.returncode,
            log=done.stdout,
            report=json.loads(report.read_text()) if report.is_file() else None,
            passes=read_multilayer(pictures[-1]) if pictures else {},
            picture_files=pictures,
        )

    return run
