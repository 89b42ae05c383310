# SPDX-License-Identifier: GPL-3.0-or-later
"""bl_info (Blender before 4.2) and blender_manifest.toml (from 4.2 on) say the same."""

import ast
import re
import sys
import tomllib

import pytest


@pytest.fixture(scope="module")
def manifest_tool(root):
    sys.path.insert(0, str(root / "addon"))
    try:
        import make_manifest
    finally:
        sys.path.pop(0)
    return make_manifest


@pytest.fixture(scope="module")
def bl_info(root, manifest_tool):
    return manifest_tool.read_bl_info(root / "addon" / "__init__.py")


def test_manifest_follows_bl_info(manifest_tool, bl_info):
    text = manifest_tool.to_toml(manifest_tool.manifest_fields(bl_info, []), {"files": 'a "b"'})
    manifest = tomllib.loads(text)
    assert manifest["version"] == ".".join(map(str, bl_info["version"]))
    assert manifest["name"] == bl_info["name"]
    assert manifest["tagline"] == bl_info["description"]
    assert manifest["permissions"] == {"files": 'a "b"'}


def test_manifest_meets_the_platform_rules(manifest_tool, bl_info):
    """Rules of the extensions platform (docs.blender.org, "How to Create Extensions")."""
    fields = manifest_tool.manifest_fields(bl_info, ["./wheels/a.whl"])
    assert re.fullmatch(r"[a-z0-9_]+", fields["id"])
    assert "blender" not in fields["name"].lower()
    assert len(fields["tagline"]) <= 64 and fields["tagline"][-1].isalnum()
    assert fields["type"] == "add-on"
    assert fields["license"] == ["SPDX:GPL-3.0-or-later"]
    assert fields["wheels"] == ["./wheels/a.whl"]
    for text in manifest_tool.PERMISSIONS.values():
        assert len(text) <= 64 and text[-1].isalnum()


def test_staged_manifest_is_current(addon_folder, manifest_tool, bl_info):
    staged = tomllib.loads((addon_folder / "blender_manifest.toml").read_text())
    expected = tomllib.loads(
        manifest_tool.to_toml(manifest_tool.manifest_fields(bl_info, []), manifest_tool.PERMISSIONS)
    )
    assert staged == expected


def test_version_is_the_projects(root, bl_info):
    cmake = (root / "CMakeLists.txt").read_text()
    version = re.search(r"project\(antiradiance VERSION ([\d.]+)", cmake).group(1)
    assert ".".join(map(str, bl_info["version"])) == version


def test_bl_info_is_a_literal_at_the_top_level(root):
    """Blender 3.x reads it from the syntax tree; anything but a literal hides the add-on."""
    tree = ast.parse((root / "addon" / "__init__.py").read_text())
    targets = [n.targets[0].id for n in tree.body if isinstance(n, ast.Assign)]
    assert targets.count("bl_info") == 1


def test_missing_bl_info_is_an_error(tmp_path, manifest_tool):
    empty = tmp_path / "__init__.py"
    empty.write_text("x = 1\n")
    with pytest.raises(ValueError, match="bl_info"):
        manifest_tool.read_bl_info(empty)
