# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of tests/python and tests/blender share; both run on the release build."""

import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = pathlib.Path(os.environ.get("ANTIRADIANCE_BUILD", ROOT / "build"))
ADDON = BUILD / "blender" / "addons" / "antiradiance"  # staged: Python files, module, shaders


@pytest.fixture(scope="session")
def root():
    return ROOT


@pytest.fixture(scope="session")
def addon_folder():
    assert ADDON.is_dir(), f"{ADDON} is missing: run packaging/build.sh first"
    return ADDON


@pytest.fixture(scope="session")
def run_blender(addon_folder):
    """run_blender(*arguments, timeout=300) -> CompletedProcess with the output as text.

    Background Blender with factory settings and the staged add-on enabled. An exception in a
    `-P` script makes the exit code 1.
    """

    def run(*arguments, timeout=300):
        command = [os.environ.get("BLENDER", "blender"), "-b", "--factory-startup"]
        command += ["--python-exit-code", "1", "--addons", "antiradiance"]
        command += [str(argument) for argument in arguments]
        environment = dict(os.environ, BLENDER_USER_SCRIPTS=str(addon_folder.parent.parent))
        return subprocess.run(
            command,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            timeout=timeout,
            check=False,
        )

    return run
