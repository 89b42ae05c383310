# SPDX-License-Identifier: GPL-3.0-or-later
"""The staged add-on as a file set: complete, and quiet towards the symbols of its host."""

import subprocess

import pytest


@pytest.fixture(scope="module")
def module_file(addon_folder):
    (file,) = addon_folder.glob("_antiradiance*.so")
    return file


def test_staged_files_are_those_of_the_sources(root, addon_folder, module_file):
    wanted = {"LICENSE", "blender_manifest.toml", module_file.name}
    for source, target in (root / "addon", addon_folder), (root / "shaders", addon_folder / "shaders"):
        for path in source.rglob("*"):
            if path.name == "make_manifest.py":  # makes blender_manifest.toml
                continue
            if path.is_file() and "__pycache__" not in path.parts and path.suffix != ".md":
                copy = target / path.relative_to(source)
                assert copy.read_bytes() == path.read_bytes(), f"{copy} is out of date"
                wanted.add(str(copy.relative_to(addon_folder)))
    staged = {
        str(path.relative_to(addon_folder))
        for path in addon_folder.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts and path.suffix != ".md"
    }
    assert staged == wanted


def test_module_exports_its_entry_point_only(module_file):
    """Blender exports its own Embree, TBB and OpenImageIO; ours must not mix with them."""
    output = subprocess.run(
        ["nm", "--dynamic", "--defined-only", "--demangle", module_file],
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    symbols = [line.split(maxsplit=2)[1:] for line in output.splitlines()]
    strong = [name for kind, name in symbols if kind in "TDBR"]
    assert strong == ["PyInit__antiradiance"]
    # What the standard library's templates leave behind is weak and identical in every program.
    assert not [name for _, name in symbols if name.startswith(("antiradiance::", "embree::", "tbb::"))]
