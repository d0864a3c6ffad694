#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Makes a board's kernel partition: kernel, first file system, command line.
#
# usage: board/image/slot.sh BOARD DEBIAN OUT      writes OUT/kernel.vfat
set -eu
[ $# = 3 ] || { echo "usage: board/image/slot.sh BOARD DEBIAN OUT" >&2; exit 2; }
here=$(dirname "$0")
board=$1
debian=$2
out=$3
. "$here/fat.sh"
files=$out/kernel
rm -rf "$files"
mkdir -p "$files"
cp "$debian"/kernel/boot/vmlinuz-* "$files/vmlinuz"
mapfile -t modules < <(grep -v '^#' "board/$board/modules_early")
board/initramfs.sh "$debian/root/bin/busybox" "$here/init.sh" "$debian/kernel" "$files/initrd" "${modules[@]}"
echo "$(cat "$here/cmdline") $(grep -v '^#' "board/$board/cmdline")" >"$files/cmdline"
fat_image "$out/kernel.vfat" 64 KERNEL "$files"
