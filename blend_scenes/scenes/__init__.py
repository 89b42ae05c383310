# SPDX-License-Identifier: GPL-3.0-or-later
"""The project's scenes, one module each; `SCENES` maps the name of each .blend to its `build`."""

from . import cornell_box

SCENES = {
    "cornell_box": cornell_box.build,
}
