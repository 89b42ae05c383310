# SPDX-License-Identifier: GPL-3.0-or-later
"""An entry of the core's options schema -> the arguments of a Blender property."""

import sys
import types

import pytest

COMMON = {"name": "x", "label": "Label", "tooltip": "What it does"}
LIMITS = {"min": 1.0, "max": 9.0, "soft_min": 2.0, "soft_max": 8.0}


@pytest.fixture(scope="module")
def properties(addon_module):
    before = sys.modules.get("bpy")
    sys.modules["bpy"] = types.ModuleType("bpy")  # only its props are used, and not here
    yield addon_module("properties")
    if before is None:
        del sys.modules["bpy"]
    else:
        sys.modules["bpy"] = before


def test_enum_items_get_numbers(properties):
    items = [("A", "First", "One"), ("B", "Second", "Two")]
    function, arguments = properties.property_arguments(
        {**COMMON, **LIMITS, "type": "ENUM", "default": "B", "items": items})
    assert function == "EnumProperty"
    assert arguments == {"name": "Label", "description": "What it does", "default": "B",
                         "items": [("A", "First", "One", 0), ("B", "Second", "Two", 1)]}


def test_int_limits_are_ints(properties):
    function, arguments = properties.property_arguments(
        {**COMMON, **LIMITS, "type": "INT", "default": 4})
    assert function == "IntProperty"
    assert {key: arguments[key] for key in LIMITS} == {"min": 1, "max": 9, "soft_min": 2, "soft_max": 8}
    assert all(type(arguments[key]) is int for key in LIMITS)


@pytest.mark.parametrize("unit, subtype", [("NONE", None), ("LENGTH", "DISTANCE"), ("FACTOR", "FACTOR")])
def test_float_units(properties, unit, subtype):
    function, arguments = properties.property_arguments(
        {**COMMON, **LIMITS, "type": "FLOAT", "default": 3.0, "unit": unit, "precision": 4})
    assert function == "FloatProperty"
    assert arguments.get("subtype") == subtype
    assert arguments["precision"] == 4 and arguments["soft_max"] == 8.0


def test_paths_and_switches(properties):
    path = properties.property_arguments({**COMMON, **LIMITS, "type": "PATH", "default": ""})
    assert path[0] == "StringProperty" and path[1]["subtype"] == "FILE_PATH"
    switch = properties.property_arguments({**COMMON, **LIMITS, "type": "BOOL", "default": True})
    assert switch == ("BoolProperty", {"name": "Label", "description": "What it does",
                                       "default": True})


def test_unknown_type_is_an_error(properties):
    with pytest.raises(ValueError, match="option x.*COLOUR"):
        properties.property_arguments({**COMMON, "type": "COLOUR", "default": 0})
