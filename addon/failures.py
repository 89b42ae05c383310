# SPDX-License-Identifier: GPL-3.0-or-later
"""What an artist is told of an exception."""
import contextlib
import traceback

from . import core
from .camera import CameraError


def told(failure: Exception) -> str:
    """The message for the artist. That of a bug, here or in the core, says little; what happened
    goes to the console, for the bug report."""
    if is_expected(failure):
        return str(failure)
    traceback.print_exception(failure)
    return f"Internal error, details are in the console: {failure!r}"


def is_expected(failure: Exception) -> bool:
    """Whether its text is meant for artists: it names the object and says what to do."""
    return core.native is None or isinstance(failure, (CameraError, core.native.SceneError))


@contextlib.contextmanager
def caught(messages: dict[str, str], what: str):
    """The exception that the block ends in becomes messages[what], which goes when it succeeds.
    For what Blender calls again and again: the console hears of a bug once."""
    try:
        yield
    except Exception as failure:
        if messages.get(what, "").endswith(repr(failure)):
            return
        messages[what] = told(failure)
    else:
        messages.pop(what, None)
