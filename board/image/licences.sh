#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Prints what is in a board's image, with versions and licences: the firmware, Debian's packages, and what it starts with.
#
# usage: board/image/licences.sh BOARD DEBIAN OUT CREATED      DEBIAN is the folder of debian.sh, OUT that of boot.sh with
#                                                              the firmware's version; CREATED as in 2026-11-23T12:00:00Z
set -eu -o pipefail
[ $# = 4 ] || { echo "usage: board/image/licences.sh BOARD DEBIAN OUT CREATED" >&2; exit 2; }
here=$(dirname "$0")
board=$1
debian=$2
out=$3
not='^$'
others=
if [ -e "$here/../$board/boot_files" ]; then
    not='^linux-image-' # its kernel is another
    others=$(sed '/^#/d; s/ .*//' "$here/../$board/boot_files" | xargs)
fi
lists=(root="$debian/root" -)
[ ! -e "$out/boot.packages/list" ] || lists+=(root="$out/boot.packages" "$out/boot.packages/list")
grep -v "$not" "$debian/packages" | awk -v name="wallwarp-$board" -v version="$(cat "$out/version")" -v created="$4" \
    -v others="$others" -f "$here/licences.awk" "${lists[@]}"
