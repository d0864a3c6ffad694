#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Packs a first file system: busybox, /init, and kernel modules, which are named in /modules/order, each after those that
# it needs and before its parameters.
#
# usage: board/initramfs.sh BUSYBOX INIT MODULES OUT MODULE...      MODULES is a folder that has lib/modules/VERSION; a
#                                                                   MODULE may have parameters behind it, in one word
set -eu -o pipefail
umask 022 # whoever makes it: the same bytes
[ $# -ge 4 ] || { echo "usage: board/initramfs.sh BUSYBOX INIT MODULES OUT MODULE..." >&2; exit 2; }
busybox=$1
init=$2
modules=$3
out=$4
shift 4
version=$(basename "$modules"/lib/modules/*)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

mkdir -p "$tree"/{bin,dev,modules}
cp "$busybox" "$tree/bin/busybox"
ln -s busybox "$tree/bin/sh"
install -m 755 "$init" "$tree/init"
: >"$tree/modules/order"
for module in "$@"; do
    # shellcheck disable=SC2086 # a word each
    modprobe -d "$modules" -S "$version" --show-depends $module
done | awk '$1 == "insmod" && !seen[$2]++' | while read -r _ file parameters; do
    cp "$file" "$tree/modules/"
    echo "${file##*/} $parameters" >>"$tree/modules/order"
done
find "$tree" -exec touch -h -d "@${SOURCE_DATE_EPOCH:-0}" {} +
(cd "$tree" && find . | LC_ALL=C sort | cpio -o -H newc -R 0:0 --reproducible --quiet) | gzip -n >"$out"
