# SPDX-License-Identifier: GPL-3.0-or-later
"""The core's compare_visibility() on scenes as the engine hands them over; for other scripts."""

import bpy
import recorder

native = recorder.addon("core").native


class Comparing:
    """Takes a Session's place: what would be rendered is compared."""

    def __init__(self, ways, reference):
        self.ways, self.reference, self.result = ways, reference, None

    def render(self, scene, options, **_):
        ways = [{**options, **way} for way in self.ways]
        self.result = native.compare_visibility(scene, ways, **self.reference)
        return {"cancelled": True}


def compare(path, ways, reference):
    """One dict for each way, which is a dict of options; `reference`: keywords."""
    bpy.ops.wm.open_mainfile(filepath=path)
    comparing = Comparing(ways, reference)
    engine = recorder.addon("engine").AntiradianceEngine
    session = engine.session
    engine.session = lambda _engine, _depsgraph: comparing
    try:
        bpy.context.scene.render.engine = "ANTIRADIANCE"
        bpy.ops.render.render()
    finally:
        engine.session = session
    return comparing.result
