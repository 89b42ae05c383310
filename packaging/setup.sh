#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the missing ones of debian-packages.txt; does nothing (in 0.1 s) when none is missing.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
mapfile -t packages < <(grep -Ev '^[[:space:]]*(#|$)' "$here/debian-packages.txt")

if ! command -v apt-get dpkg-query >/dev/null; then
    echo "setup: no apt-get here; the build needs what Debian calls: ${packages[*]}" >&2
    exit 0
fi

# dpkg-query fails on names it never heard of, and still prints the others.
installed=$(dpkg-query -W -f='${binary:Package} ${db:Status-Status}\n' "${packages[@]}" 2>/dev/null || true)
missing=()
for package in "${packages[@]}"; do
    grep -Eq "^${package//+/\\+}(:[a-z0-9]+)? installed$" <<<"$installed" || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
    exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
        echo "setup: not root and no sudo; install as root: apt-get install ${missing[*]}" >&2
        exit 1
    fi
    as_root=(sudo)
fi
apt() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y \
        -o Acquire::Retries=3 -o DPkg::Lock::Timeout=600 "$@"
}

echo "setup: installing ${missing[*]}" >&2
for attempt in 1 2 3; do
    if apt update && apt install --no-install-recommends "${missing[@]}"; then
        exit 0
    fi
    echo "setup: attempt $attempt failed" >&2
    sleep $((attempt * 5))
done
echo "setup: could not install ${missing[*]}" >&2
exit 1
