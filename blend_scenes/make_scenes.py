# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the project's scenes as .blend files beside this script, or into --output.

usage: blender -b --factory-startup -P blend_scenes/make_scenes.py -- [--output DIR]
       [--models DIR] [NAME...]
Without names, all of the project's own. Scenes of models that the project does not ship are made
by name, from the folder --models/NAME (default: ../shared/scenes beside the checkout).
"""

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
MODEL_FOLDER = HERE.parent.parent / "shared" / "scenes"
sys.path.insert(0, str(HERE))

from scenes import MODELS, NOT_SHIPPED, SCENES, kit  # noqa: E402  (the path is set just above)


def build(name, models):
    if name in SCENES:
        SCENES[name]()
        return
    source = models / name
    if not source.is_dir():
        raise SystemExit(f"{name} is made from a model that is not here: {source} is no folder; "
                         "give the folder above it with --models")
    MODELS[name](source)


def main():
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    known = [*SCENES, *MODELS]
    parser = argparse.ArgumentParser(prog="make_scenes.py", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(known))
    parser.add_argument("--output", type=Path, default=HERE, help="folder of the .blend files")
    parser.add_argument("--models", type=Path, default=MODEL_FOLDER, help="folder of the models")
    options = parser.parse_args(arguments)
    unknown = sorted(set(options.names) - set(known))
    if unknown:
        parser.error(f"no such scene: {', '.join(unknown)}; there are {', '.join(known)}")
    kept_out = sorted(NOT_SHIPPED & set(options.names))
    if kept_out and HERE.parent in (options.output.resolve(), *options.output.resolve().parents):
        parser.error(f"the licence of {', '.join(kept_out)} keeps it out of this repository: "
                     "give a folder elsewhere with --output")
    options.output.mkdir(parents=True, exist_ok=True)
    for name in options.names or SCENES:
        build(name, options.models)
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
