# SPDX-License-Identifier: GPL-3.0-or-later
"""`scene.antiradiance`, made from the core's options schema: a default is written once, in C++."""
import bpy

UNITS = {"NONE": {}, "LENGTH": {"subtype": "DISTANCE", "unit": "LENGTH"},
         "FACTOR": {"subtype": "FACTOR"}}


def property_arguments(option: dict) -> tuple[str, dict]:
    """(name of the function in bpy.props, its arguments) for one entry of the schema."""
    common = {"name": option["label"], "description": option["tooltip"],
              "default": option["default"]}
    limits = {key: option[key] for key in ("min", "max", "soft_min", "soft_max") if key in option}
    kind = option["type"]
    if kind == "ENUM":
        # Explicit numbers: a file keeps its meaning when items are added between these.
        items = [(*item, number) for number, item in enumerate(option["items"])]
        return "EnumProperty", {**common, "items": items}
    if kind == "INT":
        return "IntProperty", {**common, **{key: int(value) for key, value in limits.items()}}
    if kind == "FLOAT":
        return "FloatProperty", {**common, **limits, "precision": option["precision"],
                                 **UNITS[option["unit"]]}
    if kind == "BOOL":
        return "BoolProperty", common
    if kind == "PATH":
        return "StringProperty", {**common, "subtype": "FILE_PATH"}
    raise ValueError(f"option {option['name']}: no property for the type {kind}")


def make_group(schema: list[dict]) -> type:
    """The PropertyGroup class with one property an option."""
    annotations = {}
    for option in schema:
        function, arguments = property_arguments(option)
        annotations[option["name"]] = getattr(bpy.props, function)(**arguments)
    return type("AntiradianceSettings", (bpy.types.PropertyGroup,),
                {"__annotations__": annotations, "__doc__": "Settings of the Antiradiance engine",
                 "path_options": tuple(o["name"] for o in schema if o["type"] == "PATH")})


def option_values(settings) -> dict:
    """name -> value as the core takes it; paths absolute."""
    values = {name: getattr(settings, name) for name in type(settings).__annotations__}
    for name in settings.path_options:
        values[name] = bpy.path.abspath(values[name])
    return values
