# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of the add-on without Blender."""

import importlib
import sys
import types

import pytest


@pytest.fixture(scope="session")
def addon_module(root):
    """addon_module("colour") -> that file of addon/, imported without the add-on's __init__.py."""
    package = types.ModuleType("addon_without_blender")
    package.__path__ = [str(root / "addon")]
    sys.modules[package.__name__] = package
    return lambda name: importlib.import_module(f"{package.__name__}.{name}")
