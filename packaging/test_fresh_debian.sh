#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# test_fresh_debian.sh [--keep] [SUITE]: both quick-start commands in a new minimal Debian (bookworm
# unless told otherwise) that holds nothing but git and a clone of HEAD. Needs root and about 6 GB in
# TMPDIR (/var/tmp); takes about half an hour. --keep leaves the root behind to look at.
set -euo pipefail
checkout=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
keep=false
if [ "${1:-}" = --keep ]; then
    keep=true
    shift
fi
suite=${1:-bookworm}

if [ "$(id -u)" -ne 0 ]; then
    echo "test_fresh_debian: debootstrap and chroot need root" >&2
    exit 2
fi
command -v debootstrap >/dev/null || DEBIAN_FRONTEND=noninteractive apt-get -q -y install debootstrap
if [ -n "$(git -C "$checkout" status --porcelain)" ]; then
    echo "test_fresh_debian: HEAD is tested, without what is not committed" >&2
fi

fresh=$(mktemp -d "${TMPDIR:-/var/tmp}/antiradiance-fresh.XXXXXX")
clean_up() {
    # Without the unmount, deleting would reach into the running system.
    if mountpoint -q "$fresh/proc"; then
        umount "$fresh/proc" || return
    fi
    if $keep; then
        echo "kept: $fresh" >&2
    else
        rm -rf --one-file-system -- "$fresh"
    fi
}
trap clean_up EXIT

debootstrap --variant=minbase --include=git "$suite" "$fresh" >"$fresh.log" || {
    cat "$fresh.log" >&2
    exit 1
}
rm -f -- "$fresh.log"
mount -t proc proc "$fresh/proc" || echo "test_fresh_debian: going on without /proc" >&2
git clone -q --no-hardlinks "$checkout" "$fresh/root/antiradiance"

inside() {
    env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
        chroot "$fresh" bash -c "cd /root/antiradiance && $1"
}

begin=$SECONDS
picture=$(inside packaging/render_demo.sh | tail -n 1)
if [ ! -s "$fresh$picture" ]; then
    echo "test_fresh_debian: render_demo.sh left no picture '$picture'" >&2
    exit 1
fi
echo "render_demo.sh from nothing: $((SECONDS - begin)) s, $picture"

begin=$SECONDS
inside packaging/build.sh >/dev/null
again=$((SECONDS - begin))
echo "building again: $again s"
[ "$again" -lt 10 ]

begin=$SECONDS
inside tests/run.sh
echo "tests/run.sh: $((SECONDS - begin)) s"
echo "both commands succeed on a fresh $suite"
