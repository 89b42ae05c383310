#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# lint.sh         clang-format on all C++ files, nothing is changed
# lint.sh --fix   the same, files are changed
# lint.sh --tidy [FILE.cpp...]   clang-tidy on these files or on all of native/ (minutes)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

cpp_files() {
    find native tests -name '*.h' -o -name '*.cpp' | sort
}

case ${1:-} in
    "") mode=(--dry-run -Werror) ;;
    --fix) mode=(-i) ;;
    --tidy)
        shift
        if [ $# -eq 0 ]; then
            mapfile -t files < <(find native -name '*.cpp' | sort)
            set -- "${files[@]}"
        fi
        printf '%s\0' "$@" | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p build --quiet --warnings-as-errors='*'
        exit
        ;;
    *)
        echo "usage: lint.sh [--fix | --tidy [FILE.cpp...]]" >&2
        exit 2
        ;;
esac

# Other versions of clang-format break lines elsewhere: the one of Debian 12 decides.
if ! clang-format --version | grep -q 'version 14\.'; then
    echo "lint: clang-format 14 decides, this is $(clang-format --version): not checked"
    exit 0
fi
cpp_files | xargs clang-format "${mode[@]}"
