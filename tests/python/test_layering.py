# SPDX-License-Identifier: GPL-3.0-or-later
"""Nothing in native/ includes to its left: bind -> live -> inspect -> pipeline -> ... -> base."""

import pathlib
import re

import pytest

NATIVE = pathlib.Path(__file__).resolve().parents[2] / "native"

# What a folder may include beside itself.
ALLOWED = {
    "base": set(),
    "gpu": {"base"},
    "scene": {"base"},
    "hierarchy": {"base", "scene"},
    "links": {"base", "scene", "hierarchy"},
    "prune": {"base", "scene", "hierarchy", "links"},
    "solve": {"base", "scene", "hierarchy", "links", "prune"},
    "display": {"base", "gpu", "scene", "hierarchy", "links", "prune", "solve"},
    "pipeline": {"base", "gpu", "scene", "hierarchy", "links", "prune", "solve", "display"},
}
ALLOWED["inspect"] = ALLOWED["pipeline"] | {"pipeline"}
ALLOWED["live"] = ALLOWED["inspect"] | {"inspect"}
ALLOWED["bind"] = ALLOWED["live"] | {"live"}
ALLOWED["tools"] = ALLOWED["pipeline"] | {"pipeline"}
# The OpenGL siblings (*_gl.h, *_gl.cpp) of any folder may use the context as well.
OPENGL_SIBLING = re.compile(r"_gl\.(h|cpp)$")

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
SOURCES = sorted(path for path in NATIVE.rglob("*") if path.suffix in {".h", ".cpp"})


def includes(path):
    return INCLUDE.findall(path.read_text(encoding="utf-8"))


def test_every_folder_has_its_place():
    assert SOURCES
    assert {path.relative_to(NATIVE).parts[0] for path in SOURCES} <= set(ALLOWED)


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(NATIVE)))
def test_includes(path):
    folder = path.relative_to(NATIVE).parts[0]
    allowed = ALLOWED[folder] | {folder}
    if OPENGL_SIBLING.search(path.name):
        allowed = allowed | {"gpu"}
    for bracket, target in includes(path):
        if bracket == '"' and target.startswith("shaders/shared/"):
            assert OPENGL_SIBLING.search(path.name), "only *_gl.h shares structs with shaders"
            assert (NATIVE.parent / target).is_file()
        elif bracket == '"':
            assert (NATIVE / target).is_file(), f'"{target}" is no file of native/'
            assert target.split("/")[0] in allowed, f"{folder} must not include {target}"
        elif target.startswith("pybind11/") or target == "Python.h":
            assert folder == "bind", f"only bind includes {target}"
