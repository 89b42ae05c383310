# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the native module, or says in words that an artist can act on why it cannot be used.

`native` is the module or None; `load_error` is "" or the reason. Nothing else imports the module.
"""
import importlib
import importlib.machinery
import sys
from pathlib import Path

MODULE_NAME = "_antiradiance"


def describe_failure(folder: Path, suffixes: list[str], python: str, error: Exception) -> str:
    """Why the native module in `folder` did not load under a Python that accepts `suffixes`."""
    present = sorted(path.name for path in folder.glob(MODULE_NAME + ".*")
                     if path.suffix in {".so", ".pyd"})
    if not present:
        return (f"The native module {MODULE_NAME} is missing from {folder}. "
                "Build the project, or install the add-on from its release zip")
    if not any(name == MODULE_NAME + suffix for name in present for suffix in suffixes):
        return (f"The native module was built for another Python: found {', '.join(present)}, "
                f"this Blender runs Python {python} and needs {MODULE_NAME}{suffixes[0]}. "
                "Install the zip made for this Blender version")
    return f"The native module in {folder} does not load: {error}"


def load(package: str, folder: Path):
    """(module, "") or (None, reason)."""
    # Beside the add-on after a build or from the legacy zip; top level when it came as a wheel.
    error = None
    for name, anchor in (("." + MODULE_NAME, package), (MODULE_NAME, None)):
        try:
            return importlib.import_module(name, anchor), ""
        except ImportError as failure:
            # The first failure says more, unless it is only "not here".
            if error is None or isinstance(error, ModuleNotFoundError):
                error = failure
    python = f"{sys.version_info.major}.{sys.version_info.minor}"
    return None, describe_failure(folder, importlib.machinery.EXTENSION_SUFFIXES, python, error)


native, load_error = load(__package__, Path(__file__).resolve().parent)
