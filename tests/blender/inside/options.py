# SPDX-License-Identifier: GPL-3.0-or-later
"""{name of a setting: (default, ids of its items or None)}"""

import pathlib
import sys

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import recorder  # noqa: E402

settings = bpy.context.scene.antiradiance.bl_rna.properties
result = {}
for setting in settings:
    if setting.identifier in {"rna_type", "name"}:
        continue
    is_enum = setting.type == "ENUM"
    default = round(setting.default, 6) if setting.type == "FLOAT" else setting.default
    result[setting.identifier] = default, [i.identifier for i in setting.enum_items] if is_enum else None
recorder.finish(result)
