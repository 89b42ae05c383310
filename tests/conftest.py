# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of tests/python and tests/blender share; both run on the release build."""

import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = pathlib.Path(os.environ.get("ANTIRADIANCE_BUILD", ROOT / "build"))
ADDON = BUILD / "blender" / "addons" / "antiradiance"  # staged: Python files, module, shaders

SCREEN = ["xvfb-run", "-a", "-s", "-screen 0 1280x800x24"]
WINDOWED = ["-p", "0", "0", "1280", "800"]  # position and size


@pytest.fixture(scope="session")
def root():
    return ROOT


@pytest.fixture(scope="session")
def addon_folder():
    assert ADDON.is_dir(), f"{ADDON} is missing: run packaging/build.sh first"
    return ADDON


@pytest.fixture(scope="session")
def run_blender(addon_folder):
    """run_blender(*arguments, timeout=300, window=False) -> CompletedProcess with the output as text.

    Blender with factory settings and the staged add-on enabled, in the background or with a window
    on a screen in memory, drawn in software. An exception in a `-P` script makes the exit code 1.
    """

    def run(*arguments, timeout=300, window=False):
        command = [os.environ.get("BLENDER", "blender"), *(WINDOWED if window else ["-b"])]
        command += ["--factory-startup", "--python-exit-code", "1", "--addons", "antiradiance"]
        command += [str(argument) for argument in arguments]
        environment = dict(os.environ, BLENDER_USER_SCRIPTS=str(addon_folder.parent.parent))
        if window:
            # `timeout` ends the whole group: the screen and Blender with their shell.
            command = ["timeout", "--kill-after=10", str(timeout), *SCREEN, *command]
            environment["LIBGL_ALWAYS_SOFTWARE"] = "1"
            timeout += 20
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
