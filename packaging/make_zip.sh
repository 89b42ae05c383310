#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# make_zip.sh [OUTPUT.zip]: the built add-on as a zip for Edit > Preferences > Add-ons > Install.
# It serves Blenders with the Python version that the module was built for, on this kind of machine.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
output=$(realpath -m -- "${1:-$root/out/antiradiance.zip}")
"$root/packaging/build.sh" >&2
mkdir -p -- "$(dirname -- "$output")"

/usr/bin/python3 - "$root/build/blender/addons" "$output" <<'PYTHON'
import pathlib
import sys
import zipfile

addons, output = pathlib.Path(sys.argv[1]), sys.argv[2]
with zipfile.ZipFile(output, "w", zipfile.ZIP_DEFLATED) as archive:
    for path in sorted((addons / "antiradiance").rglob("*")):
        if path.is_file() and "__pycache__" not in path.parts:
            archive.write(path, path.relative_to(addons))
PYTHON
echo "$output"
