# SPDX-License-Identifier: GPL-3.0-or-later
"""The reason that an artist reads when the native module cannot be loaded."""

import pytest

SUFFIXES = [".cpython-311-x86_64-linux-gnu.so", ".abi3.so", ".so"]


@pytest.fixture(scope="module")
def describe(addon_module):
    core = addon_module("core")
    return lambda folder, error="broken": core.describe_failure(
        folder, SUFFIXES, "3.11", ImportError(error))


def test_missing(describe, tmp_path):
    assert "missing" in describe(tmp_path) and str(tmp_path) in describe(tmp_path)


def test_of_another_python(describe, tmp_path):
    (tmp_path / "_antiradiance.cpython-313-x86_64-linux-gnu.so").touch()
    text = describe(tmp_path)
    assert "another Python" in text and "cpython-313" in text and "3.11" in text


def test_right_python_but_broken(describe, tmp_path):
    (tmp_path / "_antiradiance.cpython-311-x86_64-linux-gnu.so").touch()
    assert "libembree3.so.3: cannot open" in describe(tmp_path, "libembree3.so.3: cannot open")


def test_one_right_module_is_enough(describe, tmp_path):
    for tag in ("311", "313"):
        (tmp_path / f"_antiradiance.cpython-{tag}-x86_64-linux-gnu.so").touch()
    assert "does not load" in describe(tmp_path)
