# SPDX-License-Identifier: GPL-3.0-or-later
"""Antiradiance: a radiosity render engine with implicit visibility for Blender."""

# The one source of truth for name, version and so on. It has to be a literal: Blender before 4.2
# reads it from the syntax tree without running the file. `make_manifest.py` derives
# blender_manifest.toml (Blender 4.2 and later) from it at build time.
bl_info = {
    "name": "Antiradiance",
    "author": "The Antiradiance authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Properties > Render > Render Engine > Antiradiance",
    "description": "Radiosity render engine with implicit visibility",
    "category": "Render",
}

if "registry" in locals():  # "Reload Scripts" runs this file again with the old modules in place.
    import importlib

    registry = importlib.reload(registry)  # noqa: F821
else:
    from . import registry


def register():
    registry.register()


def unregister():
    registry.unregister()
