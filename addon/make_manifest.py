# SPDX-License-Identifier: GPL-3.0-or-later
"""Write blender_manifest.toml (extensions, Blender 4.2 and later) from bl_info.

Build-time only, not part of the add-on: make_manifest.py ADDON_INIT OUTPUT [--wheel PATH]...
"""
import argparse
import ast
import json
from pathlib import Path

# What only extensions know; everything else comes from bl_info.
EXTENSION_ID = "antiradiance"
SCHEMA_VERSION = "1.0.0"
EXTENSION_BLENDER_MIN = (4, 2, 0)  # The first Blender that has extensions.
LICENSES = ["SPDX:GPL-3.0-or-later"]
TAGS = ["Render"]
PERMISSIONS = {"files": "Write the JSON report to a chosen path, and saved presets"}


def read_bl_info(init_file: Path) -> dict:
    """bl_info of an add-on's __init__.py, read the way Blender reads it: without running it."""
    tree = ast.parse(init_file.read_text(encoding="utf-8"), str(init_file))
    for node in tree.body:
        if isinstance(node, ast.Assign) and any(
                isinstance(t, ast.Name) and t.id == "bl_info" for t in node.targets):
            return ast.literal_eval(node.value)
    raise ValueError(f"{init_file} assigns no bl_info")


def dotted(version) -> str:
    return ".".join(str(part) for part in version)


def manifest_fields(bl_info: dict, wheels: list[str]) -> dict:
    fields = {
        "schema_version": SCHEMA_VERSION,
        "id": EXTENSION_ID,
        "version": dotted(bl_info["version"]),
        "name": bl_info["name"],
        "tagline": bl_info["description"],
        "maintainer": bl_info["author"],
        "type": "add-on",
        "tags": TAGS,
        "blender_version_min": dotted(max(tuple(bl_info["blender"]), EXTENSION_BLENDER_MIN)),
        "license": LICENSES,
    }
    if wheels:
        fields["wheels"] = wheels
    return fields


def to_toml(fields: dict, permissions: dict) -> str:
    # Strings and lists of strings only; their JSON form is valid TOML.
    lines = [f"{key} = {json.dumps(value, ensure_ascii=False)}" for key, value in fields.items()]
    lines += ["", "[permissions]"]
    lines += [f"{key} = {json.dumps(value, ensure_ascii=False)}"
              for key, value in permissions.items()]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("init_file", type=Path)
    parser.add_argument("output", type=Path)
    parser.add_argument("--wheel", action="append", default=[], dest="wheels")
    arguments = parser.parse_args()
    text = to_toml(manifest_fields(read_bl_info(arguments.init_file), arguments.wheels), PERMISSIONS)
    if not arguments.output.exists() or arguments.output.read_text(encoding="utf-8") != text:
        arguments.output.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
