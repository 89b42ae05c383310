# SPDX-License-Identifier: GPL-3.0-or-later
"""The core's compare_visibility() on scenes as the engine hands them over.

arguments: as JSON [[SCENE.blend, {option: value}], ...]. Result: one dict each.
"""

import json
import pathlib
import sys

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402

native = recorder.addon("core").native


class Comparing:
    """Takes a Session's place: what would be rendered is compared."""

    def __init__(self, options):
        self.options, self.result = options, None

    def render(self, scene, options, **_):
        self.result = native.compare_visibility(scene, {**options, **self.options})
        return {"cancelled": True}


def compare(path, options):
    bpy.ops.wm.open_mainfile(filepath=path)
    session = Comparing(options)
    recorder.addon("engine").AntiradianceEngine.session = (
        lambda _engine, _depsgraph: session)
    bpy.context.scene.render.engine = "ANTIRADIANCE"
    bpy.ops.render.render()
    return session.result


recorder.finish([compare(*pair) for pair in json.loads(recorder.arguments()[0])])
