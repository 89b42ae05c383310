#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# render_demo.sh [SCENE.blend] [OUTPUT.png|OUTPUT.exr]
# Installs what is missing, builds, renders the scene's first frame with the engine ANTIRADIANCE in
# `blender -b` and prints the picture's path as its last line. All else goes to standard error.
# BLENDER names another Blender than the one on PATH.
set -euo pipefail
exec 3>&1 1>&2
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

if [ $# -gt 2 ]; then
    echo "usage: render_demo.sh [SCENE.blend] [OUTPUT.png|OUTPUT.exr]"
    exit 2
fi
scene=$(realpath -m -- "${1:-$root/blend_scenes/cornell_box.blend}")
output=$(realpath -m -- "${2:-$root/out/$(basename -- "$scene" .blend).png}")
case ${output,,} in
    *.png) format=PNG ;;
    *.exr) format=OPEN_EXR ;;
    *)
        echo "render_demo: $output must end in .png or .exr"
        exit 2
        ;;
esac
if [ ! -f "$scene" ]; then
    echo "render_demo: there is no scene $scene"
    exit 2
fi
if ! mkdir -p -- "$(dirname -- "$output")"; then
    echo "render_demo: no picture can be written to $output; name another output"
    exit 2
fi

"$root/packaging/setup.sh"
"$root/packaging/build.sh"

# A new folder, so that the picture found there afterwards is this render's.
frames=$(mktemp -d)
trap 'rm -rf -- "$frames"' EXIT
# -f +0 is the first frame of the scene's range. Blender appends the frame's number to the name.
if ! BLENDER_USER_SCRIPTS=$root/build/blender "${BLENDER:-blender}" -b --factory-startup \
    --addons antiradiance "$scene" -E ANTIRADIANCE -o "$frames/frame_" -F "$format" -x 1 -f +0; then
    echo "render_demo: the render failed; Blender's messages above say why"
    exit 1
fi
pictures=("$frames"/frame_*)
if [ ${#pictures[@]} -ne 1 ] || [ ! -s "${pictures[0]}" ]; then
    echo "render_demo: Blender wrote no picture"
    exit 1
fi
mv -f -- "${pictures[0]}" "$output"
echo "$output" >&3
