#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# build.sh [PRESET]: configures and builds, release unless told otherwise (CMakePresets.json).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:-release}
folder=build
if [ "$preset" != release ]; then
    folder=build-$preset
fi

# Once configured, the build itself notices what makes configuring again necessary.
if [ ! -f "$folder/build.ninja" ]; then
    cmake --preset "$preset"
fi
# A compiler process takes up to 1.5 GB here: no more at once than memory allows.
jobs=$(nproc)
if [ -r /proc/meminfo ]; then
    memory_jobs=$(($(awk '/MemAvailable/ {print $2}' /proc/meminfo) / 1500000))
    if [ "$memory_jobs" -lt "$jobs" ]; then
        jobs=$((memory_jobs > 0 ? memory_jobs : 1))
    fi
fi
cmake --build "$folder" --parallel "$jobs"
