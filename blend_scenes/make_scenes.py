# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the project's scenes as .blend files beside this script, or into --output.

usage: blender -b --factory-startup -P blend_scenes/make_scenes.py -- [--output DIR] [NAME...]
Without names, all of them.
"""

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from scenes import SCENES, kit  # noqa: E402  (the path is set just above)


def main():
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="make_scenes.py", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(SCENES))
    parser.add_argument("--output", type=Path, default=HERE, help="folder of the .blend files")
    options = parser.parse_args(arguments)
    unknown = sorted(set(options.names) - set(SCENES))
    if unknown:
        parser.error(f"no such scene: {', '.join(unknown)}; there are {', '.join(SCENES)}")
    options.output.mkdir(parents=True, exist_ok=True)
    for name in options.names or SCENES:
        SCENES[name]()
        path = options.output / f"{name}.blend"
        kit.save(str(path))
        print(f"{path}: {path.stat().st_size / 1000:.0f} kB")


# Blender turns an exception in a -P script into exit code 0; a build step must see it fail.
try:
    main()
except Exception:
    import traceback

    traceback.print_exc()
    sys.exit(1)
