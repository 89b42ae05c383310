# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders one scene several times with other settings of the engine.

arguments: SCENE.blend, percentage of its resolution, folder for NAME.exr, and as JSON
{NAME: {option of scene.antiradiance: value}}. Result: {NAME: the JSON report}.
"""

import json
import pathlib
import sys

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402


def render(folder, name, options):
    scene = bpy.context.scene
    defaults = {key: scene.antiradiance.bl_rna.properties[key].default for key in options}
    report = folder / f"{name}.json"
    scene.antiradiance.report_path = str(report)
    for key, value in options.items():
        setattr(scene.antiradiance, key, value)
    scene.render.filepath = str(folder / f"{name}.exr")
    bpy.ops.render.render(write_still=True)
    for key, value in defaults.items():
        setattr(scene.antiradiance, key, value)
    return json.loads(report.read_text())


def main():
    file, percentage, folder, cases = recorder.arguments()
    bpy.ops.wm.open_mainfile(filepath=file)
    render_settings = bpy.context.scene.render
    render_settings.engine = "ANTIRADIANCE"
    render_settings.resolution_percentage = int(percentage)
    render_settings.use_file_extension = False
    render_settings.image_settings.file_format = "OPEN_EXR"
    render_settings.image_settings.color_depth = "32"
    recorder.finish({name: render(pathlib.Path(folder), name, options)
                     for name, options in json.loads(cases).items()})


main()
